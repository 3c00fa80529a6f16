// snug convert DIR FILE.inp or FILE.cdb: the body of a case with its supports and loads as CalculiX input or as a CDB
// file; SYSTEM FILE.fll or FILE.fis: a fuzzy system; CURVES FILE: curves and surfaces.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <sstream>

#include "materials/laws/solid_law.hpp"
#include "mesh/body/to_model.hpp"
#include "postproc/documents.hpp"
#include "solver/app/command.hpp"
#include "solver/app/write_named.hpp"
#include "solver/app/convert_curves.hpp"
#include "solver/app/convert_fuzzy.hpp"
#include "solver/app/prepared_case.hpp"
#include "solver/scene/constraints.hpp"
#include "solver/scene/loads.hpp"
#include "solver/scene/supports.hpp"

namespace snug::app {

namespace fs = std::filesystem;

namespace {

/// Laws that both programs know. Their volumetric energy is kappa/2 (J - 1)^2.
class LawOf {
 public:
  LawOf(const mesh::Layer& layer, Console& console) : layer_(layer), console_(console) {}

  mesh::ModelMaterial operator()() {
    const materials::Tissue tissue = materials::find_tissue(layer_.material);
    mesh::ModelMaterial material{layer_.name, mesh::ModelLaw::none, {}, tissue.density};
    std::visit([&](const auto& law) { set(law, material); }, tissue.law);
    return material;
  }

 private:
  using Material = mesh::ModelMaterial;

  void volume(const materials::Volumetric& volume, Material& to) const {
    to.constants.push_back(volume.bulk_modulus);
    if (volume.form != materials::VolumetricForm::quadratic)
      console_.note(fmt::format("note: layer \"{}\" is written with the volumetric energy kappa/2 (J - 1)^2 in place of its own, with the same kappa: neither program has it. "
                                "volumetric = \"quadratic\" makes both sides the same",
                                layer_.name));
  }
  void set(const materials::LinearElastic& law, Material& to) const {
    to.law = mesh::ModelLaw::elastic, to.constants = {law.youngs_modulus, law.poisson_ratio};
  }
  void set(const materials::NeoHooke& law, Material& to) const {
    to.law = mesh::ModelLaw::neo_hooke, to.constants = {law.shear_modulus};
    volume(law.volume, to);
  }
  void set(const materials::MooneyRivlin& law, Material& to) const {
    to.law = mesh::ModelLaw::mooney_rivlin, to.constants = {law.C10, law.C01};
    volume(law.volume, to);
  }
  void set(const materials::Ogden& law, Material& to) const {
    if (law.terms.size() > 3) refuse("has more than three Ogden terms");
    to.law = mesh::ModelLaw::ogden;
    for (const materials::OgdenTerm& term : law.terms) to.constants.insert(to.constants.end(), {term.mu, term.alpha});
    volume(law.volume, to);
  }
  template <class Law>
  void set(const Law&, Material&) const {
    refuse("has a law that CalculiX and Ansys do not have");
  }
  void refuse(const std::string& why) const {
    throw input::InputError(layer_.material.where, fmt::format("layer \"{}\" {}", layer_.name, why),
                            "write it as neo-Hooke, Mooney-Rivlin, Ogden or linear-elastic");
  }

  const mesh::Layer& layer_;
  Console& console_;
};

void refuse_what_is_lost(const input::Case& description, const mesh::BodyMesh& body, bool calculix) {
  const input::Location where{(description.directory / "case.toml").string(), 0, 0};
  if (!description.body) throw input::InputError(where, "the case has no body", "convert a case with [body]");
  if (!description.garments.empty())
    throw input::InputError(where, "the garment cannot be written: neither program has its rest metric and its contact",
                            "convert a case without [garment], [contact] and [comfort]");
  if (!body.membranes.empty())
    throw input::InputError(where, "the skin is a membrane, which cannot be written", "give the skin form = \"solid\"");
  for (const mesh::ShellTriangle& triangle : body.shell)
    if (calculix && triangle.foundation != 0.0)
      throw input::InputError(where, "CalculiX has no elastic foundation of shells", "write a CDB file, FILE.cdb");
}

mesh::BodyLoads loads_of(const input::Case& description, const mesh::BodyMesh& body) {
  const solver::Model model = solver::make_model(description, body);
  const solver::Meshes meshes{.limb = {}, .body = body, .garments = {}};
  const solver::Layout layout = solver::make_layout(model, meshes, solver::Skin::deformable);
  const solver::Supports supports(model, body, layout);
  solver::State full = solver::placed_state(layout, meshes);
  full.load = 1.0;
  const Eigen::VectorXd gap = supports.gap(full);
  if (!supports.oblique().empty())
    throw input::InputError(description.body->where, fmt::format("\"{}\" holds nodes along a direction that is none of x, y, z, which is not written", supports.oblique().front().name),
                            "turn the body so that its planes stand along x, y, z, or hold them by a [[support]]");
  mesh::BodyLoads loads;
  for (const int entry : supports.table().prescribed_entries())
    loads.held.push_back({entry / 3, entry % 3, gap.size() > 0 ? gap[entry] : 0.0});
  const input::LoadSpec load = description.load.value_or(input::LoadSpec{});
  loads.forces = solver::dead_forces(model, body);
  loads.pressures = solver::surface_pressures(load, body);
  return loads;
}

class Convert : public Command {
 public:
  std::string name() const override { return "convert"; }
  std::string summary() const override {
    return "write the body of a case with its loads as CalculiX input or as a CDB file, a fuzzy system as FLL or FIS, or curves and "
           "surfaces as JSON, STEP, IGES, DXF or SVG";
  }

  void declare(CLI::App& app) override {
    app.add_option("DIR", directory_,
                   "case directory, or a fuzzy system: a shipped name or a .fll or .fis file, or curves: a .json, .step, .igs or .dxf file")
        ->required();
    app.add_option("FILE", file_,
                   "where the result goes: FILE.inp for CalculiX and Abaqus, FILE.cdb for Ansys, FILE.fll or FILE.fis; of curves FILE.json, "
                   ".step, .igs, .dxf or .svg")
        ->required();
    app.add_option("--subdivide", subdivisions_, "of curves: steps of four-point subdivision of the nets in FILE.json, or of their picture")
        ->check(CLI::Range(0, 10));
    options_.declare(app);
  }

  int execute() override {
    console().document()["file"] = file_;
    if (is_curve_file(directory_)) {
      convert_curves(directory_, file_, subdivisions_);
      return done;
    }
    if (is_fuzzy_file(file_)) {
      convert_fuzzy(directory_, file_);
      return done;
    }
    const std::string ending = fs::path(file_).extension().string();
    if (ending != ".inp" && ending != ".cdb")
      throw input::InputError({file_, 0, 0}, "the name does not say in which format", "end it in .inp (CalculiX), .cdb (Ansys), .fll or .fis");
    const PreparedCase prepared = prepare(directory_, options_);
    const mesh::BodyMesh& body = prepared.meshes.body;
    refuse_what_is_lost(prepared.description, body, ending == ".inp");
    std::vector<mesh::ModelMaterial> materials;
    for (const mesh::Layer& layer : body.layers) materials.push_back(LawOf(layer, console())());
    const mesh::Model model = model_of(body, materials, loads_of(prepared.description, body));
    std::ostringstream out;
    ending == ".inp" ? write_calculix(out, model) : write_cdb(out, model);
    write_named(file_, out.str());
    return done;
  }

 private:
  std::string directory_, file_;
  int subdivisions_ = 0;
  CaseOptions options_;
};

}  // namespace

std::unique_ptr<Command> make_convert() { return std::make_unique<Convert>(); }

}  // namespace snug::app
