#include "mesh/formats/gmsh_file.hpp"

#include <fmt/format.h>
#include <gmsh.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <set>
#include <sstream>

#include "cases/input/files.hpp"
#include "mesh/formats/geo_script.hpp"
#include "mesh/formats/gmsh_session.hpp"

namespace snug::mesh {

namespace {

using input::InputError;

/// Numbers, texts and lists to bytes and back. Both ends are the same program on the same machine.
class Writer {
 public:
  template <class T>
  void operator()(const std::vector<T>& values) {
    const std::uint64_t count = values.size();
    bytes_.append(reinterpret_cast<const char*>(&count), sizeof count);
    bytes_.append(reinterpret_cast<const char*>(values.data()), count * sizeof(T));
  }
  void operator()(const std::string& text) { (*this)(std::vector<char>(text.begin(), text.end())); }
  void operator()(int value) { (*this)(std::vector<int>{value}); }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// What it reads was written by a process that may have been led astray: every length is held against what is there.
class Reader {
 public:
  explicit Reader(const std::string& bytes) : bytes_(bytes) {}
  template <class T>
  void operator()(std::vector<T>& values) {
    std::uint64_t count = 0;
    take(&count, sizeof count);
    if (count > (bytes_.size() - at_) / sizeof(T)) throw std::runtime_error("a list is cut short");
    values.resize(count);
    take(values.data(), count * sizeof(T));
  }
  void operator()(std::string& text) {
    std::vector<char> characters;
    (*this)(characters);
    text.assign(characters.begin(), characters.end());
  }
  void operator()(int& value) {
    std::vector<int> one;
    (*this)(one);
    if (one.size() != 1) throw std::runtime_error("a number is missing");
    value = one[0];
  }

 private:
  void take(void* to, std::size_t count) {
    if (count > bytes_.size() - at_) throw std::runtime_error("the data are cut short");
    if (count > 0) std::memcpy(to, bytes_.data() + at_, count);
    at_ += count;
  }
  const std::string& bytes_;
  std::size_t at_ = 0;
};

template <class Stream, class Items, class Visit>
void visit_list(Stream& stream, Items& items, Visit visit) {
  int count = static_cast<int>(items.size());
  stream(count);
  if constexpr (std::is_same_v<Stream, Reader>) items.resize(static_cast<std::size_t>(std::max(0, count)));
  for (auto& item : items) visit(item);
}

template <class Stream, class Mesh>
void visit_mesh(Stream& stream, Mesh& mesh) {
  stream(mesh.node_tags), stream(mesh.x);
  visit_list(stream, mesh.elements, [&](auto& e) { stream(e.type), stream(e.dimension), stream(e.entity), stream(e.tags), stream(e.nodes); });
  visit_list(stream, mesh.groups, [&](auto& g) { stream(g.name), stream(g.dimension), stream(g.tag), stream(g.entities), stream(g.nodes); });
  visit_list(stream, mesh.types, [&](auto& t) { stream(t.type), stream(t.nodes), stream(t.name), stream(t.local); });
}

/// A text as a file that stands in memory only; its name serves processes made from this one.
class MemoryFile {
 public:
  explicit MemoryFile(const std::string& text) : number_(::memfd_create("mesh", 0)) {
    for (std::size_t at = 0; number_ >= 0 && at < text.size();) {
      const ssize_t n = ::write(number_, text.data() + at, text.size() - at);
      if (n <= 0) throw std::runtime_error("no memory for the mesh file");
      at += static_cast<std::size_t>(n);
    }
  }
  ~MemoryFile() { ::close(number_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  std::string name() const { return fmt::format("/proc/self/fd/{}", number_); }

 private:
  int number_;
};

// ---- in the child ----

std::vector<GmshElements> elements_of_model() {
  std::vector<GmshElements> all;
  gmsh::vectorpair entities;
  gmsh::model::getEntities(entities);
  for (const auto& [dimension, entity] : entities) {
    std::vector<int> types;
    std::vector<std::vector<std::size_t>> tags, nodes;
    gmsh::model::mesh::getElements(types, tags, nodes, dimension, entity);
    for (std::size_t t = 0; t < types.size(); ++t)
      if (dimension >= 2)
        all.push_back({types[t], dimension, entity, {tags[t].begin(), tags[t].end()}, {nodes[t].begin(), nodes[t].end()}});
  }
  return all;
}

std::vector<GmshGroup> groups_of_model() {
  std::vector<GmshGroup> groups;
  gmsh::vectorpair pairs;
  gmsh::model::getPhysicalGroups(pairs);
  for (const auto& [dimension, tag] : pairs) {
    GmshGroup group{"", dimension, tag, {}, {}};
    gmsh::model::getPhysicalName(dimension, tag, group.name);
    if (group.name.empty()) group.name = (dimension == 0 ? "point " : dimension == 1 ? "curve " : "") + std::to_string(tag);
    gmsh::model::getEntitiesForPhysicalGroup(dimension, tag, group.entities);
    std::vector<std::size_t> nodes;
    std::vector<double> x;
    gmsh::model::mesh::getNodesForPhysicalGroup(dimension, tag, nodes, x);
    group.nodes.assign(nodes.begin(), nodes.end());
    groups.push_back(std::move(group));
  }
  return groups;
}

GmshMesh mesh_of_model() {
  GmshMesh mesh;
  std::vector<std::size_t> tags;
  std::vector<double> parameters;
  gmsh::model::mesh::getNodes(tags, mesh.x, parameters);
  mesh.node_tags.assign(tags.begin(), tags.end());
  mesh.elements = elements_of_model();
  mesh.groups = groups_of_model();
  std::set<int> types;
  for (const GmshElements& elements : mesh.elements) types.insert(elements.type);
  for (const int type : types) {
    GmshType about{type, 0, "", {}};
    int dimension = 0, order = 0, primary = 0;
    gmsh::model::mesh::getElementProperties(type, about.name, dimension, order, about.nodes, about.local, primary);
    about.local.resize(3 * static_cast<std::size_t>(std::max(0, about.nodes)));
    mesh.types.push_back(std::move(about));
  }
  return mesh;
}

// gmsh's numbers of element types.
constexpr int tet4 = 4, hex8 = 5, tet10 = 11, hex27 = 12;

/// Cells of several kinds are left as they are; the caller refuses them.
void set_order(GmshOrder order) {
  std::vector<int> types;
  gmsh::model::mesh::getElementTypes(types, 3);
  if (types.size() != 1) return;
  if (order == GmshOrder::quadratic && (types[0] == tet4 || types[0] == hex8)) gmsh::model::mesh::setOrder(2);
  if (order == GmshOrder::linear && (types[0] == tet10 || types[0] == hex27)) gmsh::model::mesh::setOrder(1);
}

/// Bytes: an empty text and the mesh, or what gmsh has to say. gmsh throws texts.
std::string open_and_mesh(const std::string& name, GmshOrder order) {
  std::string fault, step = "read";
  std::vector<std::string> log;
  Writer bytes;
  try {
    const GmshSession session;
    gmsh::logger::start();
    try {
      gmsh::open(name);
      gmsh::logger::get(log);
      std::vector<int> types;
      gmsh::model::mesh::getElementTypes(types, 3);
      step = "meshed";
      if (types.empty()) gmsh::model::mesh::generate(3);  // a file without cells is a geometry
      set_order(order);
      const GmshMesh mesh = mesh_of_model();
      bytes(std::string());
      visit_mesh(bytes, mesh);
    } catch (const std::string& text) {
      fault = text;
    } catch (const std::exception& error) {
      fault = error.what();
    } catch (...) {
      fault = "an error without a text";
    }
    gmsh::logger::get(log);
  } catch (...) {
    fault = "gmsh cannot be started";
  }
  for (const std::string& line : log)
    if (line.starts_with("Error")) {
      fault = line.substr(line.find(':') + 1);
      break;
    }
  if (fault.empty()) return bytes.take();
  Writer error;
  error(step + ": " + fault);
  return error.take();
}

// ---- in this process ----

/// gmsh's "'file', line 7: syntax error (Cylindre)" as a located error; the file that it read stands in memory.
[[noreturn]] void gmsh_says(const std::string& text, const std::string& file) {
  std::string what = text;
  int line = 0;
  const auto at = text.find(", line ");
  if (at != std::string::npos) {
    const char* begin = text.data() + at + 7;
    const auto [rest, fault] = std::from_chars(begin, text.data() + text.size(), line);
    const auto colon = text.find(':', static_cast<std::size_t>(rest - text.data()));
    if (fault == std::errc{} && colon != std::string::npos) what = text.substr(colon + 1);
  }
  const auto first = what.find_first_not_of(" :");
  throw InputError({file, line, line > 0 ? 1 : 0}, "gmsh: " + (first == std::string::npos ? what : what.substr(first)),
                   "correct it, or open the file in gmsh's window, where the place is shown");
}

/// Of a mesh in text the sections stand one after the other, each with its end.
void check_sections(const std::string& text, const std::string& file) {
  std::istringstream lines(text);
  std::string open;
  int number = 0, opened = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.pop_back();
    if (line.empty() || line[0] != '$') continue;
    if (open.empty()) {
      open = line.substr(1), opened = number;
    } else if (line == "$End" + open) {
      open.clear();
    } else {
      throw InputError({file, number, 1}, fmt::format("{} where $End{} is due", line, open), "save the mesh again");
    }
  }
  if (!open.empty()) throw InputError({file, opened, 1}, fmt::format("the section ${} has no end: the file is cut short", open), "save the mesh again");
}

bool is_text_mesh(const std::string& text) {
  const auto format = text.find("$MeshFormat");
  const auto line = text.find('\n', format);
  if (line == std::string::npos) return true;
  std::istringstream words(text.substr(line + 1, 100));
  std::string version, kind;
  words >> version >> kind;
  return kind != "1";
}

std::string prepared(const std::string& text, const std::filesystem::path& path, const std::string& file) {
  if (text.starts_with("$MeshFormat") || (text.starts_with("$Comments") && text.find("\n$MeshFormat") != std::string::npos)) {
    if (is_text_mesh(text)) check_sections(text, file);
    return text;
  }
  if (path.extension() == ".geo") return checked_script(text, file);
  throw InputError({file, 1, 1}, "the file does not begin as a gmsh mesh does, with $MeshFormat", "save it from gmsh as .msh; a script is named .geo");
}

GmshMesh received(const std::string& output, const std::string& file) {
  std::string fault;
  GmshMesh mesh;
  try {
    Reader bytes(output);
    bytes(fault);
    if (fault.empty()) visit_mesh(bytes, mesh);
  } catch (const std::runtime_error& error) {
    throw InputError({file, 0, 0}, fmt::format("gmsh read it and gave no mesh ({})", error.what()), "save the mesh again from gmsh");
  }
  if (!fault.empty()) gmsh_says(fault, file);
  if (mesh.x.size() != 3 * mesh.node_tags.size()) throw InputError({file, 0, 0}, "nodes and coordinates do not match", "save the mesh again from gmsh");
  for (const GmshElements& elements : mesh.elements)
    if (elements.nodes.size() != elements.tags.size() * static_cast<std::size_t>(mesh.type(elements.type).nodes))
      throw InputError({file, 0, 0}, "elements and their nodes do not match", "save the mesh again from gmsh");
  return mesh;
}

[[noreturn]] void ended_badly(const Contained& result, const Limits& limits, const std::string& file) {
  if (result.end == Contained::End::out_of_time)
    throw InputError({file, 0, 0}, fmt::format("gmsh was not done with it after {:.0f} s", limits.seconds),
                     "mesh it in gmsh and give the mesh (.msh), or give more time with --mesh-seconds");
  if (result.signal == 0)
    throw InputError({file, 0, 0}, "the script ends gmsh before there is a mesh", "leave that command out, or give a mesh (.msh)");
  throw InputError({file, 0, 0}, fmt::format("gmsh crashed on it (signal {}), or needed more than {:.1f} GB", result.signal, 1e-9 * limits.memory),
                   "save the mesh again from gmsh; more memory is given with --memory");
}

}  // namespace

std::vector<int> GmshMesh::types_of(int dimension) const {
  std::set<int> types;
  for (const GmshElements& one : elements)
    if (one.dimension == dimension && !one.tags.empty()) types.insert(one.type);
  return {types.begin(), types.end()};
}

const GmshType& GmshMesh::type(int number) const {
  const auto found = std::find_if(types.begin(), types.end(), [&](const GmshType& one) { return one.type == number; });
  if (found == types.end()) throw std::logic_error("an element type of gmsh that the mesh does not have");
  return *found;
}

GmshMesh read_gmsh_file(const std::filesystem::path& path, const GmshOptions& options) {
  const std::string file = path.string();
  Limits limits = options.limits;
  limits.sandbox = !options.allow_scripts;
  if (options.allow_scripts) {
    const Contained result = contained([&] { return open_and_mesh(file, options.order); }, limits);
    if (result.end != Contained::End::done) ended_badly(result, limits, file);
    return received(result.output, file);
  }
  const std::string text = prepared(input::read_file(path, {.shown_as = file}), path, file);
  limits.memory = std::max(limits.memory, 20.0 * static_cast<double>(text.size()));
  const MemoryFile copy(text);
  const Contained result = contained([&] { return open_and_mesh(copy.name(), options.order); }, limits);
  if (result.end != Contained::End::done) ended_badly(result, limits, file);
  return received(result.output, file);
}

}  // namespace snug::mesh
