#include "postproc/report/page.hpp"

#include "postproc/report/assets.hpp"
#include "postproc/report/base64.hpp"
#include "postproc/report/template.hpp"
#include "postproc/report/view.hpp"

namespace snug::postproc::report {

namespace {

constexpr double drawing_width = 760.0;  // px of the drawings without their labels

std::string page_of(const ShownRun& run, const Pictures& pictures) {
  const PressureScale scale = run.skin ? pressure_scale({&*run.skin}) : PressureScale{};
  Json view = run_view(run);
  view["locations"] = locations_view(run);
  view["has_locations"] = !view["locations"].empty();
  view["comfort"] = comfort_view(run);
  view["movement"] = movement_view(run);
  view["map"] = knows_pressure(run) ? map_view(run, scale, drawing_width) : nullptr;
  if (view["map"].is_object()) view["map"]["id"] = "map-0";
  view["pieces"] = pieces_view(run, drawing_width);
  view["convergence"] = convergence_view(run, drawing_width);
  view["has_scene"] = run.skin || run.garment;
  view["scene"] = view["has_scene"] ? scene_json(run, scale) : "";
  view["picture"] = base64({reinterpret_cast<const std::uint8_t*>(pictures.png.data()), pictures.png.size()});
  view["no_picture"] = pictures.png.empty() ? pictures.missing : "";
  view["style"] = style();
  view["three"] = view["has_scene"] ? three_script() : "";
  view["script"] = view_script();
  return fill(page_template(), view, {{"map_svg", map_template()}, {"lines_svg", lines_template()}});
}

}  // namespace

std::string page(const StoredRun& run, const Pictures& pictures) { return page_of(shown(run), pictures); }

std::string page(const std::filesystem::path& out, const Pictures& pictures) {
  const ShownRun run = read_shown(out);
  try {
    return page_of(run, pictures);
  } catch (const Json::exception& error) {
    throw not_as_written(out, error);
  }
}

}  // namespace snug::postproc::report
