// snug mesh DIR: only the meshes, with a quality table.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "postproc/grid.hpp"
#include "solver/app/cleaner.hpp"
#include "solver/app/command.hpp"
#include "solver/app/documents.hpp"
#include "solver/app/output_directory.hpp"
#include "solver/app/prepared_case.hpp"
#include "solver/app/print_plan.hpp"
#include "solver/scene/result.hpp"

namespace snug::app {

namespace fs = std::filesystem;

namespace {

/// The garments as placed round the body, without strain.
postproc::GarmentResult as_placed(const std::vector<mesh::GarmentMesh>& meshes) {
  postproc::GarmentResult garment;
  for (const mesh::GarmentMesh& mesh : meshes) solver::append(mesh, garment);
  garment.current = garment.placed;
  namespace field = postproc::field;
  const std::vector<double> zeros(garment.triangles.size(), 0.0);
  for (const auto& name : {field::tension_warp, field::tension_weft, field::shear, field::wrinkled}) garment.fields.set(name, zeros);
  garment.fields.set(field::stretch, std::vector<Eigen::Vector2d>(zeros.size(), Eigen::Vector2d::Ones()));
  garment.fields.set(field::contact_pressure, std::vector<double>(garment.placed.size(), 0.0));
  return garment;
}

class Mesh : public Command {
 public:
  std::string name() const override { return "mesh"; }
  std::string summary() const override { return "write the meshes of a case for ParaView, with a quality table"; }

  void declare(CLI::App& app) override {
    app.add_option("DIR", directory_, "case directory")->required();
    options_.declare(app);
    app.add_option("--out", out_, "where the meshes go (out/mesh in the case directory)")->type_name("DIR");
  }

  int execute() override {
    OutputDirectory out(out_.empty() ? fs::path(directory_) / "out" / "mesh" : fs::path(out_));
    const Cleaner cleaner;
    cleaner.repair(out.target());
    const PreparedCase prepared = prepare(directory_, options_);
    out.aside();
    console().print("{}\n\n{}", prepared.description.title, quality_text(prepared));
    console().document()["title"] = prepared.description.title;
    add_meshes(console().document(), prepared);
    const solver::Meshes& meshes = prepared.meshes;
    if (!meshes.body.nodes.empty()) postproc::write_body(solver::body_result(meshes.body, true), {}, out.aside() / "body.vtu");
    if (!meshes.garments.empty()) postproc::write_garment(as_placed(meshes.garments), out.aside() / "garment.vtu");
    out.commit();
    console().print("  files: {}\n", out.target().string());
    console().document()["out"] = out.target().string();
    return done;
  }

 private:
  std::string directory_, out_;
  CaseOptions options_;
};

}  // namespace

std::unique_ptr<Command> make_mesh() { return std::make_unique<Mesh>(); }

}  // namespace snug::app
