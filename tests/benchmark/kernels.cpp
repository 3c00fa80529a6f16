// Speed of the kernels that a run spends its time in. Not a test: build and run the target snug_benchmark.
#include <benchmark/benchmark.h>

#include "mesh/curves/w_surface.hpp"
#include "solver/fem/plane_shape.hpp"
#include "solver/scene/scene.hpp"
#include "tests/verification/tube.hpp"

namespace {

using namespace snug;

/// A tube with its sleeve, at the strain-free start.
struct Bench {
  input::Case description;
  solver::Meshes meshes;
  solver::Scene scene;
  solver::State state;

  static Bench make() {
    tests::TubeCase tube;
    tube.around = 24, tube.through = 3;
    input::Case c = tests::describe_tube(tube);
    solver::Meshes meshes = tests::make_meshes(c);
    solver::Scene scene = tests::make_scene(c, meshes, solver::Skin::deformable);
    solver::State state = solver::placed_state(scene.layout(), meshes);
    state.load = 0.5;
    return {std::move(c), std::move(meshes), std::move(scene), std::move(state)};
  }
};

class NullSink : public solver::Sink {
 public:
  void add(int, std::span<const double> residual, std::span<const double>) override {
    benchmark::DoNotOptimize(residual.data());
  }
};

template <class T>
void tangent(benchmark::State& loop) {
  Bench bench = Bench::make();
  auto* term = bench.scene.find<T>();
  bench.scene.look(bench.state);
  NullSink sink;
  for (auto _ : loop) term->assemble(bench.state, solver::Tangent::full, sink);
  loop.SetItemsProcessed(loop.iterations() * term->entries(bench.state).elements());
}

void search(benchmark::State& loop) {
  Bench bench = Bench::make();
  auto* contact = bench.scene.find<solver::Contact>();
  for (auto _ : loop) contact->update(bench.state);
  loop.SetItemsProcessed(loop.iterations() * static_cast<long>(contact->point_forces(bench.state).size()));
}

void assemble_and_solve(benchmark::State& loop) {
  Bench bench = Bench::make();
  bench.scene.update(bench.state);
  Eigen::VectorXd step;
  for (auto _ : loop) {
    bench.scene.assemble(bench.state, solver::Tangent::convex);
    benchmark::DoNotOptimize(bench.scene.solve(bench.state, solver::Tangent::convex, 1e-4, {}, step).ok);
  }
  loop.SetItemsProcessed(loop.iterations() * bench.scene.numbering().unknowns());
}

Eigen::Vector2d somewhere(int i) { return {0.2 + 0.001 * (i % 97), 0.3 + 0.002 * (i % 89)}; }

template <fem::Element element>
void shape(benchmark::State& loop) {
  int i = 0;
  for (auto _ : loop) benchmark::DoNotOptimize(fem::plane_shape<element>(somewhere(++i)));
}

template <fem::Element element>
void shape_values(benchmark::State& loop) {
  int i = 0;
  for (auto _ : loop) benchmark::DoNotOptimize(fem::plane_values<element>(somewhere(++i)));
}

/// Points of one bicubic rational patch, a million an iteration.
void surface_points(benchmark::State& loop) {
  using mesh::curves::SegmentKnots;
  Eigen::Matrix3Xd points(3, 16);
  Eigen::VectorXd weights(16);
  for (int k = 0; k < 16; ++k) {
    points.col(k) << k / 4, k % 4, std::sin(k);
    weights[k] = 1.0 + 0.3 * std::cos(k);
  }
  const SegmentKnots knots({-0.5, -0.2, 0.0}, {1.0, 1.1, 1.4});
  const mesh::curves::WSurface surface(knots, knots, points, weights);
  constexpr int million = 1000000;
  for (auto _ : loop) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int i = 0; i < million; ++i) sum += surface.point(i % 1009 / 1008.0, i % 997 / 996.0);
    benchmark::DoNotOptimize(sum.data());
  }
  loop.SetItemsProcessed(loop.iterations() * million);
}

}  // namespace

int main(int argc, char** argv) {
  const solver::Session session(argc, argv);
  benchmark::Initialize(&argc, argv);
  benchmark::RegisterBenchmark("tissue tangent, cells", tangent<solver::Tissue>)->UseRealTime();
  benchmark::RegisterBenchmark("fabric tangent, triangles", tangent<solver::FabricMembrane>)->UseRealTime();
  benchmark::RegisterBenchmark("contact tangent, triangles", tangent<solver::Contact>)->UseRealTime();
  benchmark::RegisterBenchmark("contact search, points", search)->UseRealTime();
  benchmark::RegisterBenchmark("assembly and factor, unknowns", assemble_and_solve)->UseRealTime();
  benchmark::RegisterBenchmark("quad9 shape", shape<fem::Element::quad9>);
  benchmark::RegisterBenchmark("quad4 shape", shape<fem::Element::quad4>);
  benchmark::RegisterBenchmark("tri6 shape", shape<fem::Element::tri6>);
  benchmark::RegisterBenchmark("quad9 values", shape_values<fem::Element::quad9>);
  benchmark::RegisterBenchmark("tri6 values", shape_values<fem::Element::tri6>);
  benchmark::RegisterBenchmark("bicubic rational surface, a million points", surface_points)->Unit(benchmark::kMillisecond);
  benchmark::RunSpecifiedBenchmarks();
}
