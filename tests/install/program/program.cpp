#include <algorithm>
#include <cstdio>
#include <snug/snug.hpp>

int main(int argc, char** argv) {
  const snug::solver::Session session(argc, argv);
  const snug::solver::PreparedCase prepared = snug::solver::prepare(argv[1]);
  const snug::postproc::RunResult result = snug::solver::solve(prepared);
  const std::vector<double>& pressure = result.body.fields[snug::postproc::field::contact_pressure];
  std::printf("%s %.9g %.9g\n", name_of(result.status), result.numbers.at("mean_contact_pressure_Pa"), *std::ranges::max_element(pressure));
}
