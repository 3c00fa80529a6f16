#include "postproc/grid.hpp"

#include <gtest/gtest.h>
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <cmath>
#include <stdexcept>

#include "tests/unit/postproc/scene.hpp"

namespace snug::postproc {
namespace {

using test::body_scene;
using test::fresh_folder;
using test::garment_scene;

vtkSmartPointer<vtkUnstructuredGrid> read(const std::filesystem::path& file) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  EXPECT_TRUE(reader->CanReadFile(file.c_str()));
  reader->SetFileName(file.c_str());
  reader->Update();
  return reader->GetOutput();
}

input::ComfortSpec trial() {
  input::ComfortSpec spec;
  spec.curves.name = "wear trial 2002";
  return spec;
}

Evaluation evaluated(const BodyResult& body) {
  RunResult run;
  run.status = postproc::Status::converged;
  run.body = body;
  return evaluate(run, trial());
}

/// The point of a cell at parametric coordinates, by VTK's own shape functions.
Eigen::Vector3d point_at(vtkCell& cell, double r, double s, double t) {
  const double at[3] = {r, s, t};
  int sub = 0;
  double x[3], weights[27];
  cell.EvaluateLocation(sub, at, x, weights);
  return {x[0], x[1], x[2]};
}

TEST(Grid, BodyFieldsComeBackThroughVtksReader) {
  // VTK reads points, both cells and every field with the values, component names and names of the result.
  const BodyResult body = body_scene();
  const auto file = fresh_folder("body") / "body.vtu";
  write_body(body, evaluated(body), file);
  const auto grid = read(file);
  ASSERT_EQ(grid->GetNumberOfPoints(), 45);
  ASSERT_EQ(grid->GetNumberOfCells(), 2);
  EXPECT_EQ(grid->GetCellType(0), VTK_TRIQUADRATIC_HEXAHEDRON);
  vtkPointData& data = *grid->GetPointData();
  for (vtkIdType n = 0; n < 45; ++n) {
    EXPECT_NEAR((Eigen::Vector3d(grid->GetPoint(n)) - body.nodes[n]).norm(), 0.0, 1e-15);
    EXPECT_DOUBLE_EQ(data.GetArray("displacement")->GetComponent(n, 1), body.fields[field::displacement][n].y());
    EXPECT_DOUBLE_EQ(data.GetArray("cauchy_stress")->GetComponent(n, 3), 10);
    EXPECT_DOUBLE_EQ(data.GetArray("contact_pressure")->GetTuple1(n), body.fields[field::contact_pressure][n]);
    EXPECT_EQ(data.GetArray("location")->GetTuple1(n), body.node_location[n]);
  }
  EXPECT_STREQ(data.GetArray("cauchy_stress")->GetComponentName(5), "XZ");
  EXPECT_EQ(data.GetArray("principal_stress")->GetNumberOfComponents(), 3);
  EXPECT_EQ(grid->GetCellData()->GetArray("layer")->GetTuple1(1), 1);
  const auto* names = vtkStringArray::SafeDownCast(grid->GetFieldData()->GetAbstractArray("location_names"));
  ASSERT_NE(names, nullptr);
  EXPECT_EQ(const_cast<vtkStringArray*>(names)->GetValue(1), "Side thigh");
}

TEST(Grid, EveryComponentStandsInItsPlace) {
  // x, y and z of a vector and the six stresses come back in their order, each node's its own.
  BodyResult body = body_scene();
  for (std::size_t n = 0; n < body.nodes.size(); ++n) {
    body.fields[field::displacement][n] = {1.0 + n, 100.0 + n, 200.0 + n};
    for (int c = 0; c < 6; ++c) body.fields[field::cauchy_stress][n][c] = 1000.0 * (c + 1) + n;
  }
  const auto file = fresh_folder("components") / "body.vtu";
  write_body(body, {}, file);
  const auto grid = read(file);
  for (vtkIdType n = 0; n < 45; ++n) {
    for (int c = 0; c < 3; ++c) EXPECT_EQ(grid->GetPointData()->GetArray("displacement")->GetComponent(n, c), body.fields[field::displacement][n][c]);
    for (int c = 0; c < 6; ++c) EXPECT_EQ(grid->GetPointData()->GetArray("cauchy_stress")->GetComponent(n, c), body.fields[field::cauchy_stress][n][c]);
  }
  EXPECT_STREQ(grid->GetPointData()->GetArray("displacement")->GetComponentName(0), "X");
}

TEST(Grid, FieldsCarryTheirUnitsForVtksReader) {
  // Another program learns from the file alone in which unit a field is; one without a unit has none, and a unit that is not
  // the one that we would have given comes back as it stands in the file.
  BodyResult body = body_scene();
  body.fields.add({"skin_temperature", "degC", "of a sensor", Place::node, std::vector<double>(body.nodes.size(), 33.0), {}});
  const auto file = fresh_folder("units") / "body.vtu";
  write_body(body, {}, file);
  const auto grid = read(file);
  const auto unit = [&](const char* name) -> std::string {
    vtkInformation& facts = *grid->GetPointData()->GetArray(name)->GetInformation();
    return facts.Has(vtkDataArray::UNITS_LABEL()) ? facts.Get(vtkDataArray::UNITS_LABEL()) : "";
  };
  EXPECT_EQ(unit("displacement"), "m");
  EXPECT_EQ(unit("contact_pressure"), "Pa");
  EXPECT_EQ(unit("coverage"), "");
  EXPECT_EQ(read_grid(file).fields.find("skin_temperature")->unit, "degC");
}

TEST(Grid, HexahedraHaveVtksNodeOrder) {
  // VTK's shape functions at the parametric place of tensor node (i, j, k) give that node, for all 27.
  const BodyResult body = body_scene();
  const auto file = fresh_folder("order") / "body.vtu";
  write_body(body, {}, file);
  const auto grid = read(file);
  for (int c = 0; c < 2; ++c)
    for (int n = 0; n < 27; ++n) {
      const auto x = point_at(*grid->GetCell(c), (n % 3) / 2.0, (n / 3 % 3) / 2.0, (n / 9) / 2.0);
      EXPECT_NEAR((x - body.nodes[body.cells[c][n]]).norm(), 0.0, 1e-12) << "cell " << c << " node " << n;
    }
}

TEST(Grid, ARigidBodyIsItsSkinInVtksNodeOrder) {
  // Without cells the facets are quads that VTK evaluates as products of parabolas along xi and eta.
  BodyResult body = body_scene();
  body.cells.clear();
  body.cell_layer.clear();
  for (const char* name : {"cauchy_stress", "von_mises", "principal_stress"}) body.fields.remove(std::string_view(name));
  const auto file = fresh_folder("rigid") / "body.vtu";
  write_body(body, evaluated(body), file);
  const auto grid = read(file);
  ASSERT_EQ(grid->GetNumberOfCells(), 2);
  EXPECT_EQ(grid->GetCellType(0), VTK_BIQUADRATIC_QUAD);
  EXPECT_EQ(grid->GetPointData()->GetArray("cauchy_stress"), nullptr);
  const double xi = 0.3, eta = -0.6;
  const auto parabolas = [](double x) { return std::array{x * (x - 1) / 2, 1 - x * x, x * (x + 1) / 2}; };
  Eigen::Vector3d expected = Eigen::Vector3d::Zero();
  for (int n = 0; n < 9; ++n) expected += parabolas(xi)[n % 3] * parabolas(eta)[n / 3] * body.nodes[body.skin_facets[1][n]];
  EXPECT_NEAR((point_at(*grid->GetCell(1), (xi + 1) / 2, (eta + 1) / 2, 0) - expected).norm(), 0.0, 1e-12);
}

TEST(Grid, SensationStandsOnCoveredNodesOfRatedLocations) {
  // Covered nodes carry the rating of their location; nodes inside and nodes without cover carry NaN.
  const BodyResult body = body_scene();
  const Evaluation evaluation = evaluated(body);
  ASSERT_TRUE(evaluation.locations[0].rating.has_value());
  const auto file = fresh_folder("sensation") / "body.vtu";
  write_body(body, evaluation, file);
  const auto grid = read(file);
  vtkDataArray& sensation = *grid->GetPointData()->GetArray("sensation");
  EXPECT_DOUBLE_EQ(sensation.GetTuple1(30), *evaluation.locations[0].rating);
  EXPECT_TRUE(std::isnan(sensation.GetTuple1(0)));
  EXPECT_TRUE(std::isnan(sensation.GetTuple1(34)));
}

TEST(Grid, GarmentFieldsComeBackThroughVtksReader) {
  // Points are the current positions, triangles keep their mid-edge nodes, stretch has a warp and a weft component.
  const GarmentResult garment = garment_scene();
  const auto file = fresh_folder("garment") / "garment.vtu";
  write_garment(garment, file);
  const auto grid = read(file);
  ASSERT_EQ(grid->GetNumberOfCells(), 2);
  EXPECT_EQ(grid->GetCellType(0), VTK_QUADRATIC_TRIANGLE);
  for (int n = 0; n < 6; ++n) EXPECT_EQ(grid->GetCell(1)->GetPointId(n), garment.triangles[1][n]);
  // Mid-edge of vertices 0 and 1 of the triangle lies at r = 1/2, s = 0.
  EXPECT_NEAR((point_at(*grid->GetCell(0), 0.5, 0, 0) - garment.current[1]).norm(), 0.0, 1e-15);
  EXPECT_DOUBLE_EQ(grid->GetPoint(8)[2], 0.02);
  EXPECT_DOUBLE_EQ(grid->GetPointData()->GetArray("displacement")->GetComponent(8, 2), 0.02);
  vtkCellData& cells = *grid->GetCellData();
  EXPECT_DOUBLE_EQ(cells.GetArray("stretch")->GetComponent(1, 1), 0.95);
  EXPECT_STREQ(cells.GetArray("stretch")->GetComponentName(0), "warp");
  EXPECT_DOUBLE_EQ(cells.GetArray("tension_warp")->GetTuple1(1), 21);
  EXPECT_DOUBLE_EQ(cells.GetArray("tension_weft")->GetTuple1(0), 10);
  EXPECT_DOUBLE_EQ(cells.GetArray("shear")->GetTuple1(1), -0.5);
  EXPECT_DOUBLE_EQ(cells.GetArray("wrinkled")->GetTuple1(1), 1);
}

TEST(Grid, AFieldOfTheWrongLengthIsRefused) {
  // A field shorter than the mesh throws and names itself, instead of leaving a file on which ParaView crashes.
  BodyResult body = body_scene();
  body.fields[field::coverage].pop_back();
  EXPECT_THROW(write_body(body, {}, fresh_folder("short") / "body.vtu"), std::runtime_error);
}

}  // namespace
}  // namespace snug::postproc
