#include "cases/input/expected.hpp"

#include "cases/input/reader.hpp"

namespace snug::input {

namespace {

struct ExpectedFile {
  std::vector<Expected> expected;
  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(Field{.key = "expected", .meaning = "what the case must give", .required = true}, self.expected);
  }
};

}  // namespace

std::vector<Expected> read_expected(const std::filesystem::path& file) {
  Diagnostics diagnostics;
  const Table table = parse_file(file, diagnostics);
  ExpectedFile result = read<ExpectedFile>(table, diagnostics);
  for (const Expected& entry : result.expected) {
    const bool number = entry.value && (entry.relative || entry.absolute) && entry.text.empty();
    const bool text = !entry.value && !entry.text.empty();
    if (!number && !text)
      diagnostics.error(entry.where, "neither a number with a tolerance nor a text", "give one of them");
  }
  diagnostics.throw_if_any();
  return result.expected;
}

}  // namespace snug::input
