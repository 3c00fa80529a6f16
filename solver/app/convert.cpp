// snug convert DIR FILE.inp: the body of a case under its load as CalculiX input; SYSTEM FILE.fll or FILE.fis: a fuzzy
// system.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <fstream>

#include "materials/laws/solid_law.hpp"
#include "mesh/formats/calculix.hpp"
#include "solver/app/command.hpp"
#include "solver/app/convert_fuzzy.hpp"
#include "solver/app/prepared_case.hpp"

namespace snug::app {

namespace fs = std::filesystem;

namespace {

mesh::NeoHookeConstants constants_of(const mesh::Layer& layer) {
  const materials::Tissue tissue = materials::find_tissue(layer.material);
  const auto* law = std::get_if<materials::NeoHooke>(&tissue.law);
  if (!law || law->volume.form != materials::VolumetricForm::quadratic)
    throw input::InputError(layer.material.where,
                            fmt::format("the law of \"{}\" is not that of CalculiX's NEO HOOKE", layer.name),
                            "write law = \"neo-Hooke\" with volumetric = \"quadratic\"");
  return {law->shear_modulus, law->volume.bulk_modulus};
}

void refuse_what_is_lost(const input::Case& description, const mesh::BodyMesh& body) {
  const input::Location where{(description.directory / "case.toml").string(), 0, 0};
  if (description.garment)
    throw input::InputError(where, "the garment cannot be written as CalculiX input",
                            "convert a case without [garment], [contact] and [comfort]");
  if (!body.membranes.empty())
    throw input::InputError(where, "the skin is a membrane, which cannot be written as CalculiX input",
                            "give the skin form = \"solid\"");
  if (body.kind != mesh::CellKind::hex27 || body.bone_nodes.empty() || description.body->kind == "imported")
    throw input::InputError(where, "only a limb of Q2/P1 hexahedra on a rigid bone can be written as CalculiX input",
                            "leave body.elements out and give the bone material = \"rigid\"");
  if (!description.support.empty() ||
      (description.load &&
       (!description.load->pressure.empty() || !description.load->traction.empty() ||
        !description.load->force.empty() || description.load->gravity != std::array<double, 3>{0, 0, 0})))
    throw input::InputError(where, "of the loads only skin_pressure can be written as CalculiX input",
                            "leave the others and [[support]] out");
  if (description.body->ends != "sliding")
    throw input::InputError(where, "the ends are " + description.body->ends, "only ends = \"sliding\" can be written");
}

class Convert : public Command {
 public:
  std::string name() const override { return "convert"; }
  std::string summary() const override {
    return "write the body of a case as CalculiX input, or a fuzzy system as FLL or FIS";
  }

  void declare(CLI::App& app) override {
    app.add_option("DIR", directory_, "case directory, or a fuzzy system: a shipped name or a .fll or .fis file")
        ->required();
    app.add_option("FILE", file_, "where the result goes, FILE.inp, FILE.fll or FILE.fis")->required();
    options_.declare(app);
  }

  int execute() override {
    if (is_fuzzy_file(file_)) {
      convert_fuzzy(directory_, file_);
      return done;
    }
    const PreparedCase prepared = prepare(directory_, options_);
    const mesh::BodyMesh& body = prepared.meshes.body;
    refuse_what_is_lost(prepared.description, body);
    std::vector<mesh::NeoHookeConstants> materials;
    for (const mesh::Layer& layer : body.layers) materials.push_back(constants_of(layer));
    const fs::path aside = file_ + ".part";
    std::ofstream out(aside);
    write_calculix(out, body, materials, prepared.description.load ? prepared.description.load->skin_pressure : 0.0);
    out.close();
    if (!out)
      throw input::InputError({file_, 0, 0}, "the file cannot be written", "name a place that can be written to");
    fs::rename(aside, file_);
    return done;
  }

 private:
  std::string directory_, file_;
  CaseOptions options_;
};

}  // namespace

std::unique_ptr<Command> make_convert() { return std::make_unique<Convert>(); }

}  // namespace snug::app
