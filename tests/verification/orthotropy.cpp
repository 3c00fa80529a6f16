// Orthotropic fabric cut at an angle and sewn (reference book 2.7).
#include "tests/verification/book.hpp"
#include "tests/verification/membrane_scene.hpp"

namespace snug::tests {
namespace {

constexpr double E1 = 1000.0, E2 = 300.0, G = 50.0, nu12 = 0.3;  // N/m

/// W = (Q11 E11^2 + Q22 E22^2)/2 + Q12 E11 E22 + G/2 (2 E12)^2 with the plane-stress stiffnesses Q.
materials::Fabric orthotropic() {
  const double nu21 = nu12 * E2 / E1, scale = 1.0 / (1.0 - nu12 * nu21);
  materials::Fabric fabric;
  fabric.warp = materials::TensionCurve::linear(scale * E1), fabric.weft = materials::TensionCurve::linear(scale * E2);
  fabric.coupling = scale * nu12 * E2;
  fabric.shear = G;
  return fabric;
}

Plane direction(double degrees) {
  const double angle = degrees * std::numbers::pi / 180.0;
  return {std::cos(angle), std::sin(angle)};
}

/// Second Piola-Kirchhoff line forces along the axes of the drawing, warp at `degrees` from x.
Eigen::Matrix2d forces(const Eigen::Matrix2d& F, double degrees) {
  Eigen::Matrix2d R;
  R.col(0) = direction(degrees), R.col(1) = direction(degrees + 90.0);
  const Eigen::Matrix2d E = R.transpose() * (0.5 * (F.transpose() * F - Eigen::Matrix2d::Identity())) * R;
  const Eigen::Vector3d N = orthotropic().unrelaxed({E(0, 0), E(1, 1), 2.0 * E(0, 1)}).force;
  return R * (Eigen::Matrix2d() << N[0], N[2], N[2], N[1]).finished() * R.transpose();
}

TEST(OffAxis, PlaneStressStiffnessesAreThoseOfTheBook) {
  const materials::MembraneResponse r = orthotropic().unrelaxed(Eigen::Vector3d::Zero());
  const char* source = "reference book 2.7 F";
  book("2.7 orthotropic fabric", "Q11, N/m", r.tangent(0, 0), 1027.749229188078, 1e-12, source);
  book("2.7 orthotropic fabric", "Q12, N/m", r.tangent(0, 1), 92.49743062692701, 1e-12, source);
  book("2.7 orthotropic fabric", "Q22, N/m", r.tangent(1, 1), 308.3247687564234, 1e-12, source);
  book("2.7 orthotropic fabric", "Q66, N/m", r.tangent(2, 2), 50.0, 1e-12, source);
}

TEST(OffAxis, ShearStiffnessIsTheInverseOfTheTurnedCompliance) {
  const Eigen::Matrix3d compliance = orthotropic().unrelaxed(Eigen::Vector3d::Zero()).tangent.inverse();
  const std::array<double, 7> exact = {50.0, 61.6016427105, 114.9425287356, 202.7027027027, 114.9425287356, 61.6016427105, 50.0};
  for (int i = 0; i < 7; ++i) {
    const Plane warp = direction(15.0 * i), weft = direction(15.0 * i + 90.0);
    // Unit shear force along the axes of the drawing, seen from the fibres; the strain's work is gamma.
    const Eigen::Vector3d N(2.0 * warp.x() * warp.y(), 2.0 * weft.x() * weft.y(), warp.x() * weft.y() + warp.y() * weft.x());
    book(fmt::format("2.7 fabric at {} deg", 15 * i), "G_xy, N/m", 1.0 / N.dot(compliance * N), exact[i], 1e-10, "reference book 2.7 F");
  }
}

struct StrainState {
  double degrees;
  std::array<double, 4> F, P, cauchy;  ///< 11 12 21 22
};

TEST(OffAxis, LineForcesAtFiniteStrainAreThoseOfTheBook) {
  for (const StrainState& s : std::vector<StrainState>{
           {0, {1.2, 0, 0, 1}, {271.32579651, 0, 0, 20.34943474}, {271.32579651, 0, 0, 16.95786228}},
           {45, {1.2, 0, 0, 1}, {113.59054471, 47.48201439, 39.56834532, 72.65878726}, {113.59054471, 39.56834532, 39.56834532, 60.54898938}},
           {30, {1.1, 0.2, 0.05, 0.95}, {163.22787282, 102.55132978, 89.32389212, 36.64437801}, {193.29558073, 102.01464438, 102.01464438, 37.95010021}}}) {
    const Eigen::Matrix2d F = Eigen::Map<const Eigen::Matrix<double, 2, 2, Eigen::RowMajor>>(s.F.data());
    const Eigen::Matrix2d P = F * forces(F, s.degrees), cauchy = P * F.transpose() / F.determinant();
    EXPECT_NEAR(cauchy(0, 1), cauchy(1, 0), 1e-12 * cauchy.norm());  // balance of moments, whatever the fibres' angle
    const std::string scene = fmt::format("2.7 warp at {:g} deg, F = [{:g} {:g}; {:g} {:g}]", s.degrees, s.F[0], s.F[1], s.F[2], s.F[3]);
    for (int i = 0; i < 4; ++i) {
      const std::string place = fmt::format("{}{}", i / 2 + 1, i % 2 + 1);
      book(scene, "P" + place + ", N/m", P(i / 2, i % 2), s.P[i], 1e-8, "reference book 2.7 F");
      book(scene, "sigma h " + place + ", N/m", cauchy(i / 2, i % 2), s.cauchy[i], 1e-8, "reference book 2.7 F");
    }
  }
}

/// A strip along x, warp at `degrees`, pulled by dead forces P (N/m) at ends that are free to turn and to shear.
Eigen::Matrix2d pulled(double degrees, double P) {
  const double length = 0.3, width = 0.1;
  Sheet sheet(mapped_sheet(6, 2, [&](double u, double v) {
    return Plane(length * (u + 0.1 * u * (1 - u) * v), width * (v + 0.2 * v * (1 - v) * u));
  }), orthotropic());
  sheet.mesh.warp.assign(sheet.mesh.triangles.size(), direction(degrees));
  sheet.hold({2}, [](const Plane&) { return true; });
  sheet.hold({0, 1}, [](const Plane& x) { return x.norm() < 1e-9; });
  sheet.hold({1}, [&](const Plane& x) { return (x - Plane(length, 0.0)).norm() < 1e-9; });
  for (const auto& t : sheet.mesh.triangles)  // Simpson's rule on the edges at the ends
    for (int k = 0; k < 3; ++k)
      for (const double end : {0.0, length}) {
        const int a = t[k], b = t[(k + 1) % 3], m = t[3 + k];
        if (std::abs(sheet.mesh.pattern[a].x() - end) > 1e-9 || std::abs(sheet.mesh.pattern[b].x() - end) > 1e-9) continue;
        const double pull = (end > 0.0 ? P : -P) * (sheet.mesh.pattern[a] - sheet.mesh.pattern[b]).norm();
        sheet.forces[a].x() += pull / 6.0, sheet.forces[b].x() += pull / 6.0, sheet.forces[m].x() += pull * 4.0 / 6.0;
      }
  sheet.settings.newton.residual = 1e-12;
  sheet.solve();
  return sheet.gradient(5, Eigen::Vector3d::Constant(1.0 / 3.0)).topRows<2>();
}

TEST(OffAxis, StripFreeToShearStretchesAsItsComplianceSays) {
  struct Row {
    double degrees, modulus, poisson, coupling;  ///< E_x (N/m), nu_xy, gamma_xy/eps_x at small strain
  };
  const double small = 1e-7;  // strain
  for (const Row& row : std::vector<Row>{{0, 1000.0, 0.3, 0.0},
                                         {15, 476.6511567527, 0.5918418530, -1.8328964143},
                                         {30, 226.8431001890, 0.7088846881, -0.9691626447},
                                         {45, 168.5393258427, 0.6853932584, -0.1966292135},
                                         {60, 179.3721973094, 0.5605381166, 0.4038862870},
                                         {75, 242.7952745455, 0.3014707992, 0.6503746549},
                                         {90, 300.0, 0.09, 0.0}}) {
    const Eigen::Matrix2d F = pulled(row.degrees, small * row.modulus), E = 0.5 * (F.transpose() * F - Eigen::Matrix2d::Identity());
    const std::string scene = fmt::format("2.7 strip at {:g} deg", row.degrees), source = "reference book 2.7 F, compliance";
    book(scene, "E_x, N/m", small * row.modulus / E(0, 0), row.modulus, 1e-6, source);
    book(scene, "nu_xy", -E(1, 1) / E(0, 0), row.poisson, 1e-6, source);
    book(scene, "gamma_xy/eps_x", 2.0 * E(0, 1) / E(0, 0), row.coupling, 1e-6, source);
  }
}

TEST(OffAxis, StripFreeToShearMeetsItsNominalForceAtLargeStretch) {
  const std::array<double, 4> stretches = {1.05, 1.1, 1.2, 1.5};
  const std::map<double, std::array<double, 4>> nominal = {{0, {53.8125, 115.5, 264.0, 937.5}},
                                                           {45, {9.06952247, 19.46629213, 44.49438202, 158.00561798}},
                                                           {90, {16.14375, 34.65, 79.2, 281.25}}};
  for (const auto& [degrees, forces] : nominal)
    for (int i = 0; i < 4; ++i)
      book(fmt::format("2.7 strip at {:g} deg", degrees), fmt::format("stretch under {:g} N/m", forces[i]), pulled(degrees, forces[i])(0, 0),
           stretches[i], 1e-8, "reference book 2.7 F, finite strain");
}

/// Cuts the triangles right of x + slope y = 0.5 off as a panel of their own: turned, moved, and sewn back on.
void cut_off(mesh::GarmentMesh& mesh, double slope, double degrees, std::vector<char>& used) {
  const int nodes = static_cast<int>(mesh.pattern.size());
  Eigen::Matrix2d turn;
  turn.col(0) = direction(degrees), turn.col(1) = direction(degrees + 90.0);
  used.assign(2 * nodes, 0);
  const auto beyond = [&](int node) { return mesh.pattern[node].x() + slope * mesh.pattern[node].y() - 0.5; };
  for (int node = 0; node < nodes; ++node) {
    mesh.pattern.emplace_back(turn * mesh.pattern[node] + Plane(3.0, 1.0));
    mesh.placed.push_back(mesh.placed[node]);
    mesh.merged.push_back(std::abs(beyond(node)) < 1e-9 ? node : nodes + node);
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    double side = 0.0;
    for (int k = 0; k < 3; ++k) side += beyond(mesh.triangles[t][k]);
    for (int& node : mesh.triangles[t]) {
      if (side > 0.0) node += nodes;
      used[mesh.merged[node]] = 1;
    }
    if (side > 0.0) mesh.warp[t] = turn * mesh.warp[t];
  }
}

// A seam between two panels cut along any line leaves a uniform stretch uniform (seam patch test).
TEST(OffAxis, SeamLeavesAUniformFieldAsItIs) {
  Eigen::Matrix2d F;
  F << 1.15, 0.04, -0.03, 1.1;
  for (const double slope : {0.0, 0.25}) {
    mesh::GarmentMesh mesh = mapped_sheet(6, 4, [&](double u, double v) { return Plane(u - 4.0 * (u - u * u) * slope * v, v); });
    const std::vector<Plane> flat = mesh.pattern;
    const auto rim = [&](int node) { return std::min({flat[node].x(), flat[node].y(), 1.0 - flat[node].x(), 1.0 - flat[node].y()}) < 1e-9; };
    mesh.warp.assign(mesh.triangles.size(), direction(30.0));
    const int nodes = static_cast<int>(flat.size());
    for (int node = 0; node < nodes; ++node)
      if (rim(node)) mesh.placed[node].head<2>() = F * flat[node];
    std::vector<char> used;
    cut_off(mesh, slope, 70.0, used);
    Sheet sheet(std::move(mesh), orthotropic());
    for (int node = 0; node < 2 * nodes; ++node)
      for (int c = 0; c < 3; ++c) {
        const int first = sheet.mesh.merged[node];
        const bool moves = c < 2 && used[first] && !rim(node % nodes);
        sheet.master[sheet.layout["garment"](node, c)] = moves ? sheet.layout["garment"](first, c) : -1;
      }
    sheet.settings.newton.residual = 1e-12;
    sheet.solve([](solver::State& state, double) { state.load = 1.0; });
    double worst = 0.0;
    for (int node = 0; node < 2 * nodes; ++node)
      if (used[sheet.mesh.merged[node]]) worst = std::max(worst, (sheet.at(node).head<2>() - F * flat[node % nodes]).norm());
    book("2.7 seam patch test", fmt::format("largest deviation from the uniform field, m; slope {:g}", slope), worst, 0.0, 1e-10, "uniform stretch, reference book 2.7");
  }
}

}  // namespace
}  // namespace snug::tests
