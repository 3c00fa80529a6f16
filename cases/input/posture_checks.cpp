#include "cases/input/posture_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "cases/input/suggestion.hpp"

namespace snug::input {

namespace {

void check_bones(const Case& c, Diagnostics& diagnostics) {
  std::set<std::string> names;
  for (const MovingBoneSpec& bone : c.bones) {
    if (!names.insert(bone.name).second) diagnostics.error(bone.where, fmt::format("a second bone is called \"{}\"", bone.name), "give each bone a name of its own");
    if (!bone.joint) continue;
    const JointSpec& joint = *bone.joint;
    if (joint.towards.empty() && !joint.direction)
      diagnostics.error(joint.where, fmt::format("the joint of \"{}\" does not say on which side the bone lies", bone.name),
                        "add towards = \"lower\" (the name of a cut of the body), or direction = [x, y, z] along the limb into the bone");
    if (joint.towards == "everything" && (joint.direction || joint.blend))
      diagnostics.error(joint.where, fmt::format("\"{}\" is everything, and its joint has a {}", bone.name, joint.direction ? "direction" : "blend"), "leave it out: the whole body goes as one");
  }
  if (!c.bones.empty() && c.postures.empty())
    diagnostics.error(c.bones.front().where, "there is a [[bone]] but no [[posture]] that moves it", "add [[posture]] with name and move, or leave [[bone]] out");
}

void check_moves(const PostureSpec& posture, const Case& c, Diagnostics& diagnostics) {
  std::vector<std::string> names;
  for (const MovingBoneSpec& bone : c.bones) names.push_back(bone.name);
  std::set<std::string> moved;
  for (const BoneMoveSpec& move : posture.move) {
    const auto bone = std::find_if(c.bones.begin(), c.bones.end(), [&](const auto& one) { return one.name == move.bone; });
    if (!moved.insert(move.bone).second) diagnostics.error(move.where, fmt::format("the posture \"{}\" moves \"{}\" twice", posture.name, move.bone), "give turn and shift together");
    if (bone == c.bones.end())
      diagnostics.error(move.where, fmt::format("the posture \"{}\" moves \"{}\", which is no bone of the case", posture.name, move.bone),
                        names.empty() ? "add [[bone]] with its name and joint" : did_you_mean(move.bone, names));
    else if (!bone->joint)
      diagnostics.error(move.where, fmt::format("the posture \"{}\" moves \"{}\", which has no joint", posture.name, move.bone),
                        fmt::format("give the [[bone]] one: joint = {{ point = [\"0 mm\", \"0 mm\", \"300 mm\"], towards = \"lower\" }}"));
  }
}

void check_names(const Case& c, Diagnostics& diagnostics) {
  std::set<std::string> names = {"dressed"};
  for (const PostureSpec& posture : c.postures) {
    if (!names.insert(posture.name).second)
      diagnostics.error(posture.where, posture.name == "dressed" ? "a posture is called \"dressed\", which is where the movement begins" : fmt::format("a second posture is called \"{}\"", posture.name),
                        "give each posture a name of its own");
    check_moves(posture, c, diagnostics);
  }
}

}  // namespace

void check_postures(const Case& c, Diagnostics& diagnostics) {
  check_bones(c, diagnostics);
  check_names(c, diagnostics);
  if (c.postures.empty()) return;
  const PostureSpec& first = c.postures.front();
  const auto still = [](const BoneMoveSpec& move) { return move.turn == 0.0 && move.shift == std::array<double, 3>{0, 0, 0}; };
  if (std::all_of(first.move.begin(), first.move.end(), still))
    diagnostics.error(first.where, fmt::format("the first posture, \"{}\", moves nothing", first.name), "add move = { bone = \"shank\", turn = \"60 deg\" }; the position in which the garment is put on comes before it by itself");
  if (!c.body) diagnostics.error(first.where, "there is a [[posture]] but no [body]", "add [body] or leave it out");
  for (const SupportSpec& support : c.support)
    if (support.on == "bone") diagnostics.error(support.where, "a [[support]] holds the bone, which postures move", "leave the support out: bones are held, and go where postures put them");
  if (!c.tools.empty()) diagnostics.error(first.where, "the case has a [[tool]], and postures move the body under it", "leave one of them out: a tool on a body that moves is not available");
}

}  // namespace snug::input
