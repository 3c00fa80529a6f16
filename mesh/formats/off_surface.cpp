#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <sstream>

#include "mesh/formats/surface_readers.hpp"

namespace snug::mesh {

namespace {

using input::InputError;

/// Lines that hold something, without comments.
class Lines {
 public:
  Lines(const std::string& content, const std::string& file) : stream_(content), file_(file) {}
  /// The numbers of the next line; words that are none end it.
  std::vector<double> next() {
    for (std::string text; std::getline(stream_, text);) {
      ++number_;
      text = text.substr(0, text.find('#'));
      if (number_ == 1) text = text.substr(std::min(text.size(), text.find_first_of(" \t\r")));  // behind the word OFF
      std::istringstream words(text);
      std::vector<double> values;
      for (std::string word; words >> word;) {
        double value = 0.0;
        const auto [rest, fault] = std::from_chars(word.data() + (word[0] == '+' ? 1 : 0), word.data() + word.size(), value);
        if (fault != std::errc{} || rest != word.data() + word.size()) throw InputError({file_, number_, 1}, fmt::format("\"{}\" is no number", word), "write numbers only");
        values.push_back(value);
      }
      if (!values.empty()) return values;
    }
    throw InputError({file_, number_, 1}, "the OFF file ends before its last face", "write the file again");
  }
  input::Location where() const { return {file_, number_, 1}; }

 private:
  std::istringstream stream_;
  const std::string& file_;
  int number_ = 0;
};

std::string first_word(const std::string& content) { return content.substr(0, content.find_first_of(" \t\r\n")); }

}  // namespace

bool is_off(const std::string& content) {
  const std::string word = first_word(content.substr(0, 16));
  return word == "OFF" || word == "COFF" || word == "NOFF" || word == "CNOFF" || word == "STOFF";
}

TriangleSurface parse_off(const std::string& content, const std::string& file) {
  Lines lines(content, file);
  const std::vector<double> counts = lines.next();
  if (counts.size() < 2 || counts[0] < 0.0 || counts[1] < 0.0) throw InputError(lines.where(), "an OFF file without numbers of vertices and faces", "write them behind OFF");
  TriangleSurface surface;
  while (static_cast<double>(surface.vertices.size()) < counts[0]) {
    const std::vector<double> x = lines.next();
    if (x.size() < 3 || !std::isfinite(x[0] + x[1] + x[2])) throw InputError(lines.where(), fmt::format("a vertex with {} coordinates", x.size()), "write x y z");
    surface.vertices.emplace_back(x[0], x[1], x[2]);
  }
  for (double f = 0.0; f < counts[1]; ++f) {
    const std::vector<double> face = lines.next();
    const double corners = face[0];
    if (!(corners >= 1.0) || corners >= static_cast<double>(face.size())) throw InputError(lines.where(), fmt::format("a face that announces {:g} vertices and has {}", corners, face.size() - 1), "write 3 a b c");
    for (int n = 1; n <= static_cast<int>(corners); ++n)
      if (!(face[n] >= 0.0 && face[n] < counts[0])) throw InputError(lines.where(), fmt::format("the face names vertex {:g} of {:g}", face[n], counts[0]), "name vertices of the file, counted from 0");
    for (int n = 3; n <= static_cast<int>(corners); ++n) surface.triangles.push_back({static_cast<int>(face[1]), static_cast<int>(face[n - 1]), static_cast<int>(face[n])});
  }
  return surface;
}

}  // namespace snug::mesh
