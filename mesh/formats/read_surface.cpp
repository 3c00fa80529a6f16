#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <string_view>

#include "cases/input/files.hpp"
#include "mesh/formats/surface_readers.hpp"

namespace snug::mesh {

namespace {

using input::InputError;
using input::Location;

struct Word {
  std::string_view text;
  int column = 1;
};

std::vector<Word> words_of(std::string_view line) {
  std::vector<Word> words;
  for (std::size_t i = 0; i < line.size();) {
    const auto begin = line.find_first_not_of(" \t\r", i);
    if (begin == std::string_view::npos || line[begin] == '#') break;
    const auto end = std::min(line.find_first_of(" \t\r", begin), line.size());
    words.push_back({line.substr(begin, end - begin), static_cast<int>(begin) + 1});
    i = end;
  }
  return words;
}

/// One line of a file, with its place for errors.
struct Line {
  const std::string& file;
  int number = 0;
  std::vector<Word> words;

  Location at(std::size_t word) const { return {file, number, words[std::min(word, words.size() - 1)].column}; }
};

double coordinate_at(const Line& line, std::size_t word) {
  const std::string_view text = line.words[word].text;
  const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
  double value = 0.0;
  const auto [rest, fault] = std::from_chars(begin, text.data() + text.size(), value);
  if (fault == std::errc{} && rest == text.data() + text.size() && std::isfinite(value)) return value;
  throw InputError(line.at(word), fmt::format("\"{}\" is no number", text), "write a coordinate such as 0.125");
}

Eigen::Vector3d point_at(const Line& line) {
  if (line.words.size() < 4)
    throw InputError(line.at(0), fmt::format("a vertex with {} coordinates", line.words.size() - 1),
                     fmt::format("write {} x y z", line.words[0].text));
  return {coordinate_at(line, 1), coordinate_at(line, 2), coordinate_at(line, 3)};
}

/// Vertex of a face: "7", "7/2/3", "7//3" or, counted from the end, "-1". The count from 1 becomes one from 0.
int vertex_at(const Line& line, std::size_t word, std::size_t known) {
  const std::string_view text = line.words[word].text.substr(0, line.words[word].text.find('/'));
  int index = 0;
  const auto [rest, fault] = std::from_chars(text.data(), text.data() + text.size(), index);
  if (fault != std::errc{} || rest != text.data() + text.size() || index == 0)
    throw InputError(line.at(word), fmt::format("\"{}\" is no vertex number", line.words[word].text),
                     "write numbers from 1, such as f 1 2 3");
  return index > 0 ? index - 1 : static_cast<int>(known) + index;
}

/// Records of OBJ and of plain v/f text; a face may name vertices that follow later, so that ranges are checked last.
class VertexFaceReader {
 public:
  void read(const Line& line) {
    const std::string_view key = line.words[0].text;
    if (key == "v") {
      surface_.vertices.push_back(point_at(line));
    } else if (key == "f" || key == "fo") {  // fo: of version 2
      add_face(line);
    } else if (!ignored(key)) {
      throw InputError(line.at(0), fmt::format("\"{}\" begins no record of an OBJ or v/f file", key),
                       "write vertices as v x y z and faces as f a b c");
    }
  }

  TriangleSurface finish() {
    for (std::size_t n = 0; n < surface_.triangles.size(); ++n)
      for (int vertex : surface_.triangles[n])
        if (vertex < 0 || vertex >= static_cast<int>(surface_.vertices.size()))
          throw InputError(places_[n],
                           fmt::format("the face names vertex {} of {}", vertex + 1, surface_.vertices.size()),
                           "name vertices of the file, counted from 1");
    return std::move(surface_);
  }

 private:
  static bool ignored(std::string_view key) {
    // of the format's reference: normals, textures, groups, looks, lines and points
    static constexpr std::array<std::string_view, 24> keys = {"vn",     "vt",     "vp",    "g",        "o",        "s",   "usemtl",     "mtllib",    "l",     "p",     "begin", "end",
                                                              "mg",     "usemap", "maplib", "bevel",   "c_interp", "lod", "d_interp",   "shadow_obj", "trace_obj", "ctech", "stech", "call"};
    return std::find(keys.begin(), keys.end(), key) != keys.end();
  }

  void add_face(const Line& line) {
    if (line.words.size() < 4)
      throw InputError(line.at(0), fmt::format("a face with {} vertices", line.words.size() - 1),
                       "give at least three vertices");
    const auto vertex = [&](std::size_t word) { return vertex_at(line, word, surface_.vertices.size()); };
    for (std::size_t n = 3; n < line.words.size(); ++n) {  // a fan from the first vertex
      surface_.triangles.push_back({vertex(1), vertex(n - 1), vertex(n)});
      places_.push_back(line.at(0));
    }
  }

  TriangleSurface surface_;
  std::vector<Location> places_;  // of each triangle
};

std::string small_letters(std::string_view text) {
  std::string small(text);
  std::transform(small.begin(), small.end(), small.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return small;
}

/// Text STL: facets of three `vertex` lines between `outer loop` and `endloop`, in small letters or capitals.
class StlTextReader {
 public:
  void read(const Line& line) {
    const std::string key = small_letters(line.words[0].text);
    if (key == "vertex") {
      surface_.vertices.push_back(point_at(line));
    } else if (key == "endloop") {
      const int last = static_cast<int>(surface_.vertices.size()) - 1;
      if (last + 1 != 3 * (static_cast<int>(surface_.triangles.size()) + 1))
        throw InputError(line.at(0), "the facet does not have three vertices", "write three vertex lines a facet");
      surface_.triangles.push_back({last - 2, last - 1, last});
    }
  }
  TriangleSurface finish() { return std::move(surface_); }

 private:
  TriangleSurface surface_;
};

template <class Reader>
TriangleSurface read_text(const std::string& content, const std::string& file) {
  Reader reader;
  std::istringstream stream(content);
  int number = 0;
  std::string joined;  // of lines that go on behind a backslash
  for (std::string text; std::getline(stream, text);) {
    ++number;
    const auto last = text.find_last_not_of(" \t\r");
    if (last != std::string::npos && text[last] == '\\') {
      joined += text.substr(0, last) + ' ';
      continue;
    }
    joined += text;
    const Line line{file, number, words_of(joined)};
    if (!line.words.empty()) reader.read(line);
    joined.clear();
  }
  return reader.finish();
}

constexpr std::size_t stl_head = 84, stl_facet = 50;  // bytes

/// A binary STL announces its number of facets after 80 bytes.
std::size_t announced_facets(const std::string& content) {
  std::uint32_t facets = 0;
  if (content.size() >= stl_head) std::memcpy(&facets, content.data() + 80, sizeof facets);
  return facets;
}

/// Its size tells whether that is what it is; some programs put bytes behind the last facet.
bool is_binary_stl(const std::string& content) {
  if (content.size() < stl_head) return false;
  const std::size_t size = stl_head + stl_facet * announced_facets(content);
  return content.size() == size || (content.size() > size && size > stl_head && content.find('\0') != std::string::npos);
}

TriangleSurface read_binary_stl(const std::string& content, const std::string& file) {
  TriangleSurface surface;
  const std::size_t end = stl_head + stl_facet * announced_facets(content);
  for (std::size_t at = stl_head; at < end; at += stl_facet) {
    std::array<float, 12> values;  // normal, then three vertices
    std::memcpy(values.data(), content.data() + at, sizeof values);
    for (int n = 3; n < 12; n += 3) {
      surface.vertices.emplace_back(values[n], values[n + 1], values[n + 2]);
      if (!surface.vertices.back().allFinite())
        throw InputError({file},
                         fmt::format("facet {} has a coordinate that is no number", (at - stl_head) / stl_facet + 1),
                         "write the file again");
    }
    const int last = static_cast<int>(surface.vertices.size()) - 1;
    surface.triangles.push_back({last - 2, last - 1, last});
  }
  return surface;
}

std::string_view trimmed_start(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\n");
  return first == text.npos ? std::string_view() : text.substr(first);
}

bool is_text_stl(const std::string& content) {
  const std::string head = small_letters(content.substr(0, std::min<std::size_t>(content.size(), 4096)));
  return trimmed_start(head).starts_with("solid") && head.find("facet") != std::string::npos;
}

TriangleSurface read_any(const std::string& content, const std::string& file) {
  if (is_ply(content)) return parse_ply(content, file);
  if (is_off(content)) return parse_off(content, file);
  if (is_binary_stl(content)) return read_binary_stl(content, file);
  if (is_text_stl(content)) return read_text<StlTextReader>(content, file);
  if (content.find('\0') != std::string::npos)
    throw InputError({file}, content.size() > stl_head ? fmt::format("the file is neither text nor a complete binary STL: it announces {} facets and has room for {}",
                                                                     announced_facets(content), (content.size() - stl_head) / stl_facet)
                                                       : "the file is neither text nor a complete binary STL",
                     "write it again as OBJ, STL, PLY or OFF");
  return read_text<VertexFaceReader>(content, file);
}

}  // namespace

TriangleSurface read_surface(const std::filesystem::path& path) {
  const std::string file = path.string();
  TriangleSurface surface = seams_closed(weld(read_any(input::read_file(path), file)));
  if (surface.triangles.empty())
    throw InputError({file}, "the file holds no triangles", "give a surface as OBJ, STL, PLY or OFF");
  return surface;
}

}  // namespace snug::mesh
