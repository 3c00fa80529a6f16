// What the terminal says of a state that is not the answer, of warnings, hems and assumptions, and of a run that takes long.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "solver/app/final_table.hpp"
#include "solver/app/progress.hpp"

namespace snug::tests {
namespace {

using testing::HasSubstr, testing::Not;

// A partial run says at which part of which stage it stands, how stiff its body is and how far friction is bound, what to try, and that
// nothing is made of its pressures; a converged one says none of that.
TEST(FinalTable, TellsWhatTheStateIs) {
  postproc::RunResult run;
  run.status = postproc::Status::partial;
  run.truth = {.stage = "body, step by step", .fraction = 0.334, .stiffening = 12.0, .friction_bound = 4.0};
  run.remedies = {"choose a larger size", "hold an edge"};
  const std::string text = app::final_text(run, {}, "out");
  for (const char* part : {"33.4 % of the stage \"body, step by step\"", "12 times as stiff", "4 times its coefficient", "no class, rating, threshold or comfort",
                           "what to try        choose a larger size\n                     hold an edge"})
    EXPECT_THAT(text, HasSubstr(part));
  run.status = postproc::Status::converged, run.remedies.clear();
  EXPECT_THAT(app::final_text(run, {}, "out"), Not(HasSubstr("stage")));
}

// Warnings come with place and remedy, a hem with its line load and the strip that is left out, an assumption as it is.
TEST(FinalTable, WarnsWithPlaceAndRemedy) {
  postproc::RunResult run;
  run.status = postproc::Status::converged;
  run.warnings = {{"gathered cloth", "20 % of the cloth lies in folds", "heights 10 to 20 mm", "hold both edges", "gathered_share", 0.2, 0.05}};
  run.hems = {{.edge = "upper", .length = 0.5, .strip = 0.021, .force = 3.0, .line_load = 0.417}};
  run.assumptions = {"friction 0.3: textiles on dry skin"};
  const std::string text = app::final_text(run, {}, "out");
  for (const char* part : {"warning            gathered cloth: 20 % of the cloth lies in folds (heights 10 to 20 mm); hold both edges",
                           "upper edge: 0.417 N/m over 500 mm", "leave out 21.0 mm beside it", "assumed            friction 0.3"})
    EXPECT_THAT(text, HasSubstr(part));
}

// The live line counts attempts from the second on; a run is overdue from three times its forecast on, and says what it is doing.
TEST(Progress, NamesTheAttemptAndSaysWhenItIsOverdue) {
  solver::Progress progress{"body", 4, 3, 0.5, 2e-4, 812, 12.0, 5.0, 1};
  EXPECT_THAT(app::progress_text(progress), Not(HasSubstr("attempt")));
  EXPECT_FALSE(app::overdue(progress));
  progress.attempt = 3, progress.elapsed = 15.1;
  EXPECT_THAT(app::progress_text(progress), HasSubstr("increment   4, attempt 3"));
  EXPECT_TRUE(app::overdue(progress));
  EXPECT_THAT(app::overdue_text(progress), HasSubstr("15 s so far, 5 s were expected; now at \"body\", increment 4, attempt 3"));
  progress.expected = 1.0, progress.elapsed = 9.0;  // a few seconds are nobody's worry
  EXPECT_FALSE(app::overdue(progress));
}

}  // namespace
}  // namespace snug::tests
