// A directory of results and the value it is written from and read back to.
#include "postproc/store.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <map>

#include "postproc/comparison.hpp"
#include "postproc/recorders.hpp"
#include "postproc/report/page.hpp"
#include "tests/unit/postproc/scene.hpp"

namespace snug::postproc {
namespace {

using test::fresh_folder;
using test::run_scene;
using testing::HasSubstr;

Evaluation evaluated_run(const RunResult& run) {
  input::ComfortSpec trial;
  trial.curves.name = "wear trial 2002";
  return evaluate(run, trial);
}

/// A shell or a rigid body is its skin.
void keep_skin_only(RunResult& run) {
  run.body.cells.clear(), run.body.cell_layer.clear(), run.body.layers.clear();
}

/// Results of each kind of scene.
std::map<std::string, RunResult> scenes() {
  std::map<std::string, RunResult> runs;
  runs["whole"] = run_scene();
  runs["whole"].history.front().energy = 1.0 / 3.0;
  runs["whole"].history.front().residual = 1.23456789e-5;
  runs["whole"].numbers["not computed"] = std::numeric_limits<double>::quiet_NaN();
  runs["body alone"] = run_scene(), runs["body alone"].garment = {};
  runs["garment alone"] = run_scene(), runs["garment alone"].body = {};
  RunResult& rigid = runs["rigid skin"] = run_scene();
  keep_skin_only(rigid);
  for (const char* name : {"cauchy_stress", "von_mises", "principal_stress"}) rigid.body.fields.remove(std::string_view(name));
  rigid.body.fields.set(field::shear_traction, std::vector<Eigen::Vector3d>(45, {1.0, -0.0, 1e-300}));
  rigid.body.fields.set(field::slip, std::vector<double>(45, 2.0));
  RunResult& shell = runs["shell"] = run_scene();
  keep_skin_only(shell), shell.garment = {};
  shell.body.fields.set(field::stress_top, std::vector<Stress>(45, Stress::Constant(0.1)));
  shell.body.fields.set(field::stress_bottom, std::vector<Stress>(45, Stress::Constant(-0.1)));
  runs["law of Laplace"] = run_scene();
  runs["law of Laplace"].history.clear();
  RunResult& imported = runs["imported"] = run_scene();
  for (int n = 0; n < 45; ++n) imported.body.node_numbers.push_back(1000 - 7 * n);
  runs["fields of others"] = run_scene();
  runs["fields of others"].body.fields.add({"warmth", "K", "temperature", Place::node, std::vector<double>(45, 300.0), {}});
  runs["fields of others"].garment.fields.add({"flow", "m/s", "of air", Place::cell, std::vector<Eigen::Vector2d>(2, {0.1, 0.2}), {"warp", "weft"}});
  return runs;
}

/// To the bit, so that one NaN is as good as itself.
template <class Value>
bool same_bits(const std::vector<Value>& a, const std::vector<Value>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(Value)) == 0);
}

void expect_same(const Grid& a, const Grid& b) {
  EXPECT_TRUE(same_bits(a.points, b.points));
  EXPECT_EQ(a.types, b.types);
  EXPECT_EQ(a.nodes, b.nodes);
  EXPECT_EQ(a.ends, b.ends);
  EXPECT_EQ(a.names, b.names);
  const auto count = [](const Grid& grid) { return std::distance(grid.fields.begin(), grid.fields.end()); };
  ASSERT_EQ(count(a), count(b));
  for (auto one = a.fields.begin(), other = b.fields.begin(); one != a.fields.end(); ++one, ++other) {
    EXPECT_EQ(one->name, other->name);
    EXPECT_EQ(one->unit, other->unit) << one->name;
    EXPECT_EQ(one->description, other->description) << one->name;
    EXPECT_EQ(one->place, other->place) << one->name;
    EXPECT_EQ(one->components, other->components) << one->name;
    ASSERT_EQ(one->values.index(), other->values.index()) << one->name;
    std::visit([&]<class Value>(const std::vector<Value>& values) {
      EXPECT_TRUE(same_bits(values, std::get<std::vector<Value>>(other->values))) << one->name;
    }, one->values);
  }
}

void expect_same(const std::vector<Iteration>& a, const std::vector<Iteration>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t n = 0; n < a.size(); ++n) {
    const auto numbers = [](const Iteration& row) {
      return std::vector<double>{row.load, row.residual, row.complementarity, row.step, row.energy, row.seconds,
                                 1.0 * row.increment, 1.0 * row.iteration, 1.0 * row.contact_nodes, 1.0 * row.changed, 1.0 * row.attempt};
    };
    EXPECT_TRUE(same_bits(numbers(a[n]), numbers(b[n]))) << "row " << n;
    EXPECT_EQ(a[n].event, b[n].event);
  }
}

// Of every kind of scene the directory gives back what was written, to the last bit: grids with all fields, history, summary, comfort.
TEST(Store, GivesBackWhatWasWrittenToTheBit) {
  for (const auto& [kind, run] : scenes()) {
    SCOPED_TRACE(kind);
    const auto folder = fresh_folder("store");
    const Evaluation evaluation = evaluated_run(run);
    const StoredRun stored = stored_run(run, evaluation, {.command = "snug run it"}, folder);
    write_results(run, evaluation, stored, folder);
    const StoredRun read = read_run(folder);
    EXPECT_EQ(read.name, stored.name);
    EXPECT_EQ(read.summary, stored.summary);
    EXPECT_EQ(read.comfort, stored.comfort);
    EXPECT_EQ(read.skin_nodes, stored.skin_nodes);
    expect_same(read.history, stored.history);
    ASSERT_EQ(read.body_grid.has_value(), stored.body_grid.has_value());
    ASSERT_EQ(read.garment_grid.has_value(), stored.garment_grid.has_value());
    if (read.body_grid) expect_same(*read.body_grid, *stored.body_grid);
    if (read.garment_grid) expect_same(*read.garment_grid, *stored.garment_grid);
  }
}

// The page that a run makes of what it has in memory is the page that is made of its directory later, byte for byte.
TEST(Store, ThePageFromMemoryIsThatOfTheDirectory) {
  for (const auto& [kind, run] : scenes()) {
    SCOPED_TRACE(kind);
    const auto folder = fresh_folder("store-page");
    const Evaluation evaluation = evaluated_run(run);
    const StoredRun stored = stored_run(run, evaluation, {}, folder);
    write_results(run, evaluation, stored, folder);
    EXPECT_EQ(report::page(stored, {"", "no display"}), report::page(folder, {"", "no display"}));
  }
}

// Nodes of an imported body are called by the numbers of its file, whatever their order: the map shows each its own pressure.
TEST(Store, NumbersOfAnImportedBodyLeadToItsNodes) {
  RunResult run = scenes().at("imported");
  const auto folder = fresh_folder("store-imported");
  write_results(run, {}, folder);
  const StoredRun read = read_run(folder);
  ASSERT_EQ(read.skin_nodes.size(), 15u);
  EXPECT_EQ(read.skin_nodes.front(), 30);
  std::ofstream(folder / "skin.csv") << "node\n999\n";  // none of 1000, 993, ...
  EXPECT_THROW(read_run(folder), input::InputError);
}

// Fields that are no displacement and no stress are compared by their name, each against its own size, and only when asked for.
TEST(Store, EveryFieldOfTheNodesCanBeCompared) {
  RunResult run = run_scene();
  const auto first = fresh_folder("store-first"), second = fresh_folder("store-second");
  write_results(run, {}, first);
  for (double& p : run.body.fields[field::contact_pressure]) p *= 1.5;
  write_results(run, {}, second);
  const NodalField was = read_field(first), is = read_field(second);
  EXPECT_TRUE(compare(is, was).within());
  const Comparison asked = compare(is, was, {.columns = {"contact_pressure", "coverage"}});
  ASSERT_EQ(asked.columns.size(), 2u);
  EXPECT_NEAR(asked.columns[0].maximum, 150.0, 1e-9);
  EXPECT_EQ(asked.columns[0].scale, 300.0);
  EXPECT_EQ(asked.columns[0].unit, "Pa");
  EXPECT_EQ(asked.columns[1].scale, 1.0);
  EXPECT_TRUE(asked.columns[1].within);
  EXPECT_FALSE(asked.within());
}

// Whoever publishes first, files list our own fields in one order and others behind; two of one name are refused.
TEST(Fields, StandInTheOrderOfFiles) {
  Fields fields;
  fields.add({"zeal", "", "", Place::node, std::vector<double>(3, 0.0), {}});
  fields.set(field::slip, std::vector<double>(3, 0.0));
  fields.set(field::displacement, std::vector<Eigen::Vector3d>(3));
  fields.add({"art", "", "", Place::node, std::vector<double>(3, 0.0), {}});
  std::vector<std::string> names;
  for (const NamedField& field : fields) names.push_back(field.name);
  EXPECT_EQ(names, (std::vector<std::string>{"displacement", "slip", "zeal", "art"}));
  EXPECT_THROW(fields.add(named(field::slip, std::vector<double>(3, 1.0))), std::logic_error);
  EXPECT_THROW(fields[field::coverage], std::out_of_range);
  EXPECT_EQ(fields.find(field::coverage), nullptr);
}

}  // namespace
}  // namespace snug::postproc
