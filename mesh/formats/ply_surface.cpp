#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <map>
#include <optional>
#include <sstream>

#include "mesh/formats/surface_readers.hpp"

namespace snug::mesh {

namespace {

using input::InputError;

enum class Coding { text, little, big };

struct Property {
  std::string name, type, count_type;  ///< count_type: of a list
};
struct Element {
  std::string name;
  long long count = 0;
  std::vector<Property> properties;
};
struct Header {
  Coding coding = Coding::text;
  std::vector<Element> elements;
  std::size_t end = 0;  ///< where the data begin
  int lines = 0;
};

int size_of(const std::string& type) {
  static const std::map<std::string, int> sizes = {{"char", 1},  {"uchar", 1},  {"int8", 1},  {"uint8", 1},  {"short", 2},   {"ushort", 2}, {"int16", 2},  {"uint16", 2},
                                                   {"int", 4},   {"uint", 4},   {"int32", 4}, {"uint32", 4}, {"float", 4},   {"float32", 4}, {"double", 8}, {"float64", 8}};
  const auto it = sizes.find(type);
  return it == sizes.end() ? 0 : it->second;
}

Header header_of(const std::string& content, const std::string& file) {
  Header header;
  for (std::size_t at = 0; at < content.size();) {
    const std::size_t next = std::min(content.find('\n', at), content.size());
    std::istringstream words(content.substr(at, next - at));
    at = next + 1;
    ++header.lines;
    std::string key, a, b, c, d;
    words >> key;
    const auto wrong = [&](const std::string& found, const std::string& remedy) { return InputError({file, header.lines, 1}, found, remedy); };
    if (key == "format") {
      words >> a;
      if (a != "ascii" && a != "binary_little_endian" && a != "binary_big_endian") throw wrong(fmt::format("a PLY file of the format \"{}\"", a), "write it as ascii or binary");
      header.coding = a == "ascii" ? Coding::text : a == "binary_little_endian" ? Coding::little : Coding::big;
    } else if (key == "element") {
      Element element;
      if (!(words >> element.name >> element.count) || element.count < 0) throw wrong("an element without a name and a count", "write element vertex 1000");
      header.elements.push_back(element);
    } else if (key == "property") {
      words >> a;
      Property property;
      if (a == "list") words >> property.count_type >> property.type >> property.name;
      else property.type = a, words >> property.name;
      if (header.elements.empty() || size_of(property.type) == 0 || (a == "list" && size_of(property.count_type) == 0) || property.name.empty())
        throw wrong("a property that is none", "write property float x, or property list uchar int vertex_indices");
      header.elements.back().properties.push_back(property);
    } else if (key == "end_header") {
      header.end = std::min(at, content.size());
      return header;
    }
  }
  throw InputError({file, header.lines, 1}, "the header of the PLY file does not end", "write the file again");
}

/// Numbers one after the other, from text or bytes.
class Numbers {
 public:
  Numbers(const std::string& content, const Header& header, const std::string& file) : content_(content), at_(header.end), coding_(header.coding), file_(file) {}

  double next(const std::string& type) { return coding_ == Coding::text ? from_text() : from_bytes(type); }
  std::size_t left() const { return content_.size() - at_; }

 private:
  [[noreturn]] void cut_short() const { throw InputError({file_}, "the PLY file ends before its last element", "write the file again"); }

  double from_text() {
    at_ = content_.find_first_not_of(" \t\r\n", at_);
    if (at_ == std::string::npos) at_ = content_.size(), cut_short();
    double value = 0.0;
    const char* begin = content_.data() + at_ + (content_[at_] == '+' ? 1 : 0);
    const auto [rest, fault] = std::from_chars(begin, content_.data() + content_.size(), value);
    if (fault != std::errc{}) {
      const int line = 1 + static_cast<int>(std::count(content_.begin(), content_.begin() + static_cast<std::ptrdiff_t>(at_), '\n'));
      throw InputError({file_, line, 1}, fmt::format("\"{}\" is no number", content_.substr(at_, std::min<std::size_t>(12, content_.find_first_of(" \t\r\n", at_) - at_))), "write a number such as 0.125");
    }
    at_ = static_cast<std::size_t>(rest - content_.data());
    return value;
  }

  double from_bytes(const std::string& type) {
    const int size = size_of(type);
    if (left() < static_cast<std::size_t>(size)) cut_short();
    std::array<char, 8> raw{};
    std::memcpy(raw.data(), content_.data() + at_, size);
    if (coding_ == Coding::big) std::reverse(raw.begin(), raw.begin() + size);
    at_ += size;
    if (size == 8) return std::bit_cast<double>(raw);
    std::array<char, 4> four{raw[0], raw[1], raw[2], raw[3]};
    if (type == "float" || type == "float32") return std::bit_cast<float>(four);
    const auto bits = std::bit_cast<std::uint32_t>(four);
    if (type[0] == 'u') return bits;
    return size == 1 ? static_cast<std::int8_t>(bits) : size == 2 ? static_cast<std::int16_t>(bits) : static_cast<std::int32_t>(bits);
  }

  const std::string& content_;
  std::size_t at_;
  Coding coding_;
  const std::string& file_;
};

void read_vertex(const Element& element, Numbers& numbers, TriangleSurface& surface, const std::string& file) {
  Eigen::Vector3d x = Eigen::Vector3d::Constant(std::nan(""));
  for (const Property& property : element.properties) {
    long long count = property.count_type.empty() ? 1 : static_cast<long long>(numbers.next(property.count_type));
    for (double value = 0.0; count > 0; --count) {
      value = numbers.next(property.type);
      if (property.name.size() == 1 && property.name[0] >= 'x' && property.name[0] <= 'z') x[property.name[0] - 'x'] = value;
    }
  }
  if (!x.allFinite()) throw InputError({file}, fmt::format("vertex {} has no three coordinates", surface.vertices.size() + 1), "give each vertex x, y and z");
  surface.vertices.push_back(x);
}

void read_face(const Element& element, long long number, Numbers& numbers, TriangleSurface& surface, const std::string& file) {
  for (const Property& property : element.properties) {
    const bool corners = property.name == "vertex_indices" || property.name == "vertex_index";
    const double announced = property.count_type.empty() ? 1.0 : numbers.next(property.count_type);
    if (announced < 0.0 || announced > static_cast<double>(numbers.left())) throw InputError({file}, fmt::format("face {} announces {:g} vertices", number + 1, announced), "write the file again");
    std::vector<int> polygon;
    for (int n = 0; n < static_cast<int>(announced); ++n) {
      const double value = numbers.next(property.type);
      if (!corners) continue;
      if (!(value >= 0.0 && value < static_cast<double>(surface.vertices.size())))
        throw InputError({file}, fmt::format("face {} names vertex {:g} of {}", number + 1, value, surface.vertices.size()), "name vertices of the file, counted from 0");
      polygon.push_back(static_cast<int>(value));
    }
    for (std::size_t n = 2; n < polygon.size(); ++n) surface.triangles.push_back({polygon[0], polygon[n - 1], polygon[n]});
  }
}

}  // namespace

bool is_ply(const std::string& content) { return content.starts_with("ply\n") || content.starts_with("ply\r"); }

TriangleSurface parse_ply(const std::string& content, const std::string& file) {
  const Header header = header_of(content, file);
  Numbers numbers(content, header, file);
  TriangleSurface surface;
  for (const Element& element : header.elements)
    for (long long n = 0; n < element.count; ++n) {
      if (element.name == "vertex") {
        read_vertex(element, numbers, surface, file);
      } else if (element.name == "face") {
        read_face(element, n, numbers, surface, file);
      } else {
        for (const Property& property : element.properties)
          for (double count = property.count_type.empty() ? 1.0 : numbers.next(property.count_type); count >= 1.0; --count) numbers.next(property.type);
      }
      if (element.properties.empty()) break;  // a count alone holds nothing
    }
  return surface;
}

}  // namespace snug::mesh
