// Garments of the tests for the standing figure (standing_bodies.hpp), in centimetres.
#pragma once

#include <string>

namespace snug::mesh {

/// Fronts and backs of two legs with these outlines, and their six seams. The front right and the back left piece are drawn, the others are their mirrors.
inline std::string legs_pattern(const std::string& front, const std::string& back) {
  const auto drawn = [](const std::string& name, const std::string& outline) { return "[[piece]]\nname = \"" + name + "\"\nedges = [\n" + outline + "]\n"; };
  const auto mirrored = [](const std::string& name, const std::string& of) { return "[[piece]]\nname = \"" + name + "\"\nmirror_of = \"" + of + "\"\n"; };
  return "unit = \"1 cm\"\n" + drawn("front right", front) + mirrored("front left", "front right") + drawn("back left", back) + mirrored("back right", "back left") +
         R"([[seam]]
name = "side right"
a = "front right.side"
b = "back right.side"
[[seam]]
name = "side left"
a = "front left.side"
b = "back left.side"
[[seam]]
name = "inseam right"
a = "front right.inseam"
b = "back right.inseam"
[[seam]]
name = "inseam left"
a = "front left.inseam"
b = "back left.inseam"
[[seam]]
name = "centre front"
a = "front right.crotch + front right.rise"
b = "front left.rise + front left.crotch"
[[seam]]
name = "centre back"
a = "back left.crotch + back left.rise"
b = "back right.rise + back right.crotch"
)";
}

/// A tenth narrower than the legs.
inline const std::string test_leggings = legs_pattern(R"(  { name = "hem",    from = [3, 16] },
  { name = "inseam", kind = "cubic", from = [15, 16], control = [[17, 40], [19, 60]] },
  { name = "crotch", kind = "cubic", from = [23, 74], control = [[19.5, 74.5], [19, 78]] },
  { name = "rise",   from = [18.5, 82] },
  { name = "waist",  from = [18, 104] },
  { name = "side",   kind = "cubic", from = [0, 104], control = [[0, 80], [0, 50]] },
)",
                                                      R"(  { name = "hem",    from = [3, 16] },
  { name = "inseam", kind = "cubic", from = [15, 16], control = [[17, 40], [19, 60]] },
  { name = "crotch", kind = "cubic", from = [25, 74], control = [[20.5, 74.5], [20, 78]] },
  { name = "rise",   from = [19.5, 82] },
  { name = "waist",  from = [18, 106] },
  { name = "side",   kind = "cubic", from = [0, 104], control = [[0, 80], [0, 50]] },
)");

/// Front and back, each whole; a tenth narrower than the chest.
inline const std::string test_vest = R"(unit = "1 cm"
[[piece]]
name = "front"
edges = [
  { name = "hem",        from = [-18, 0] },
  { name = "left",       from = [18, 0] },
  { name = "armhole left", kind = "cubic", from = [19, 32], control = [[14, 36], [12, 46]] },
  { name = "strap left", from = [11, 55] },
  { name = "neck",       kind = "cubic", from = [7, 56], control = [[6, 40], [-6, 40]] },
  { name = "strap right", from = [-7, 56] },
  { name = "armhole right", kind = "cubic", from = [-11, 55], control = [[-12, 46], [-14, 36]] },
  { name = "right",      from = [-19, 32] },
]
[[piece]]
name = "back"
edges = [
  { name = "hem",        from = [-18, 0] },
  { name = "right",      from = [18, 0] },
  { name = "armhole right", kind = "cubic", from = [19, 32], control = [[14, 36], [12, 46]] },
  { name = "strap right", from = [11, 55] },
  { name = "neck",       kind = "cubic", from = [7, 56], control = [[6, 50], [-6, 50]] },
  { name = "strap left", from = [-7, 56] },
  { name = "armhole left", kind = "cubic", from = [-11, 55], control = [[-12, 46], [-14, 36]] },
  { name = "left",       from = [-19, 32] },
]
[[seam]]
name = "left"
a = "front.left"
b = "back.left"
[[seam]]
name = "right"
a = "front.right"
b = "back.right"
[[seam]]
name = "strap left"
a = "front.strap left"
b = "back.strap left"
[[seam]]
name = "strap right"
a = "front.strap right"
b = "back.strap right"
)";

/// One piece with a seam behind.
inline const std::string test_skirt = R"(unit = "1 cm"
[[piece]]
name = "skirt"
edges = [
  { name = "hem",   from = [-60, 0] },
  { name = "one",   from = [60, 0] },
  { name = "waist", from = [44, 45] },
  { name = "other", from = [-44, 45] },
]
[[seam]]
name = "back"
a = "skirt.one"
b = "skirt.other"
)";

}  // namespace snug::mesh
