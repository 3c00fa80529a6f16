// What a case says of its garments, and the raw tests that fabrics are made of.
#include <cmath>
#include <fstream>
#include <stdexcept>

#include "cases/input/case_checks.hpp"
#include "cases/input/garment_checks.hpp"
#include "cases/input/reader.hpp"
#include "materials/fabric/raw_test.hpp"
#include "materials/fabric/reduction.hpp"
#include "mesh/body/elliptic_outline.hpp"
#include "mesh/garment/garment_cut.hpp"
#include "tests/fuzz/targets.hpp"

namespace snug::fuzz {

namespace {

namespace fs = std::filesystem;

const fs::path patterns = fs::path(SNUG_SOURCE_DIR) / "tests/data/patterns";

/// A garment that is read whole must also be cut and, where it is a tube on this limb, meshed and placed, or be refused. The pattern of a sewn one is
/// always the same: which file is read is not the text's to say.
void use_garment(const fs::path&, const std::string& text) {
  input::Diagnostics diagnostics;
  const input::Table root = input::parse_text(text, {"fuzz", 1, 1}, diagnostics);
  diagnostics.throw_if_any();
  const input::Table* table = input::garment_table(root, 0);
  if (!table) return;
  input::Case description;
  description.garments.push_back(input::read<input::GarmentSpec>(*table, diagnostics));
  input::complete(description, root);
  input::check_garments(description, root, diagnostics);
  diagnostics.throw_if_any();
  input::GarmentSpec& garment = description.garments.front();
  for (const input::BandSpec& band : garment.band) input::rest_length(band, 0.3);
  if (garment.pattern.sewn()) garment.pattern.file = patterns / "skirt.toml";
  const mesh::GarmentCut cut = mesh::read_cut(garment);
  const mesh::CutSize size = mesh::size_of(cut);
  if (garment.pattern.sewn() || (garment.pattern.graduated() && garment.pattern.circumferences.empty())) return;
  const mesh::Limb limb = mesh::straight_limb({0, 0.05, 0.05, 0, 0}, {0, 0.015, 0.015, 0, 0}, 0.0, 0.5);
  if (!(size.area < 10.0) || garment.cell_size > 0.0 || garment.zone.size() > 5) return;  // how many triangles fit is the program's to refuse
  mesh::make_tube_mesh(garment, limb, 0.05);
}

void use_raw_test(const fs::path& file, const std::string& text) {
  const fs::path csv = fs::path(file).replace_extension(".csv");
  std::ofstream(csv, std::ios::binary) << text;
  const materials::RawTest test = materials::read_test(csv, {.width = 0.05, .gauge_length = 0.1});
  for (const auto& [symbol, value] : materials::reduced(test))
    if (!std::isfinite(value)) throw std::logic_error(symbol + " is no number");
}

}  // namespace

std::vector<Target> garment_targets() {
  const std::string common = "fabric = \"N85L15\"\nposition = \"40 mm\"\n";
  return {
      {"garment", use_garment,
       {"[garment]\n" + common + "pattern = { file = \"skirt.toml\", from_height = \"100 mm\", to_height = \"40 cm\", pieces = [\"front\", \"back\"], girth_scale = 0.9 }\n"
        "[[garment.band]]\nedge = \"waist\"\nrest_length = \"-8 %\"\nstiffness = \"150 N/m\"\nwidth = \"3 cm\"\n[[garment.zone]]\npieces = [\"front\"]\nfabric = \"C98L2\"\n",
        "[[garment]]\n" + common + "pattern = { kind = \"graduated\", length = \"200 mm\", circumferences = [{ height = \"0 mm\", girth = \"250 mm\" }, { height = \"80 mm\", girth = \"30 cm\" }, "
        "{ height = \"200 mm\", girth = \"350 mm\" }] }\nzone = [{ from_height = \"50 mm\", to_height = \"90 mm\", fabric = \"C98L2\" }]\n"
        "band = { edge = \"upper\", rest_length = \"310 mm\", stiffness = \"150 N/m\", width = \"3 cm\" }\n",
        "[garment]\n" + common + "pattern = { kind = \"graduated\", length = \"200 mm\", pressures = [{ height = \"0 mm\", pressure = \"20 mmHg\" }, { height = \"20 cm\", pressure = \"1 kPa\" }] }\n"},
       {"from_height = \"", "to_height = \"", "height = \"", "girth = \"", "-8 %", "1e999", "nan", "\"0 mm\"", "1e-300 mm", "kind = \"tube\", ", "[[garment.zone]]\n", "[[garment.band]]\n",
        "flat_circumference = \"290 mm\", ", "{ height = \"80 mm\", girth = \"30 cm\" }, ", ", ", "}", "]", "-1"}},
      {"rawtest", use_raw_test,
       {"elongation [%],force [N/m]\n0,0\n5,20\n10,60\n15,150\n10,40\n5,8\n0,0\n", "shear angle [degree],force [N/m]\n-8,-3\n0,0.1\n8,3\n0,-0.1\n-8,-3\n",
        "curvature [1/cm],moment [gf]\n0,0\n2.5,0.2\n0,0.02\n-2.5,-0.2\n0,-0.02\n", "thickness [mm],pressure [gf/cm2]\n1.2,0.5\n1.0,10\n0.8,50\n"},
       {",", "\n", ";", "1e308", "-1e308", "nan", "[N]", "[mm]", "[%]", "\"", "\xFF\xFE", "elongation [%]", "0,0\n"}},
  };
}

}  // namespace snug::fuzz
