#include "mesh/formats/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_set>

#include "cases/input/files.hpp"
#include "mesh/formats/fields.hpp"

namespace snug::mesh {

int node_count(ElementKind kind) {
  switch (kind) {
    case ElementKind::tri3: return 3;
    case ElementKind::tet4:
    case ElementKind::quad4: return 4;
    case ElementKind::tri6: return 6;
    case ElementKind::hex8:
    case ElementKind::quad8: return 8;
    case ElementKind::tet10: return 10;
    case ElementKind::hex20: return 20;
    case ElementKind::pyramid5: return 5;
    case ElementKind::wedge6: return 6;
    case ElementKind::pyramid13: return 13;
    case ElementKind::wedge15: return 15;
  }
  return 0;
}

int corner_count(ElementKind kind) {
  switch (kind) {
    case ElementKind::tri3:
    case ElementKind::tri6: return 3;
    case ElementKind::hex8:
    case ElementKind::hex20: return 8;
    case ElementKind::wedge6:
    case ElementKind::wedge15: return 6;
    case ElementKind::pyramid5:
    case ElementKind::pyramid13: return 5;
    default: return 4;
  }
}

bool is_shell(ElementKind kind) {
  return kind == ElementKind::tri3 || kind == ElementKind::tri6 || kind == ElementKind::quad4 || kind == ElementKind::quad8;
}

bool is_tetrahedron(ElementKind kind) { return kind == ElementKind::tet4 || kind == ElementKind::tet10; }

std::string to_string(ElementKind kind) {
  const int corners = corner_count(kind);
  const char* shape = is_shell(kind) ? (corners == 3 ? "triangle" : "quadrilateral")
                      : corners == 4 ? "tetrahedron" : corners == 5 ? "pyramid" : corners == 6 ? "wedge" : "hexahedron";
  return fmt::format("{}-node {}", node_count(kind), shape);
}

const std::vector<std::vector<int>>& model_faces(ElementKind kind) {
  static const std::vector<std::vector<int>> tetrahedron = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}},
      hexahedron = {{0, 1, 2, 3}, {4, 7, 6, 5}, {0, 4, 5, 1}, {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}},
      wedge = {{0, 1, 2}, {3, 5, 4}, {0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}},
      pyramid = {{0, 1, 2, 3}, {0, 4, 1}, {1, 4, 2}, {2, 4, 3}, {3, 4, 0}},
      triangle = {{0, 1, 2}}, quadrilateral = {{0, 1, 2, 3}};
  if (is_shell(kind)) return corner_count(kind) == 3 ? triangle : quadrilateral;
  const int corners = corner_count(kind);
  return corners == 4 ? tetrahedron : corners == 5 ? pyramid : corners == 6 ? wedge : hexahedron;
}

const std::vector<std::array<int, 2>>& model_edges(ElementKind kind) {
  static const std::vector<std::array<int, 2>> tetrahedron = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}},
      hexahedron = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}},
      wedge = {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}},
      pyramid = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}}, triangle = {{0, 1}, {1, 2}, {2, 0}},
      quadrilateral = {{0, 1}, {1, 2}, {2, 3}, {3, 0}}, none = {};
  if (node_count(kind) == corner_count(kind)) return none;
  const int corners = corner_count(kind);
  if (is_shell(kind)) return corners == 3 ? triangle : quadrilateral;
  return corners == 4 ? tetrahedron : corners == 5 ? pyramid : corners == 6 ? wedge : hexahedron;
}

namespace {

/// Reports what refers to nodes that are not there.
class NodeCheck {
 public:
  NodeCheck(const Model& model, const std::string& file, input::Diagnostics& diagnostics)
      : file_(file), diagnostics_(diagnostics) {
    for (const ModelNode& node : model.nodes) known_.insert(node.number);
  }
  void operator()(int node, int line, const std::string& what) {
    if (known_.contains(node) || diagnostics_.errors().size() >= most_model_errors) return;
    diagnostics_.error({file_, line, line > 0 ? 1 : 0}, fmt::format("{} names node {}, which is not there", what, node),
                       "give the node its coordinates, or leave it out");
  }

 private:
  const std::string& file_;
  input::Diagnostics& diagnostics_;
  std::unordered_set<int> known_;
};

template <class Items>
void sort_by_number(Items& items, const char* what, const std::string& file, input::Diagnostics& diagnostics) {
  std::stable_sort(items.begin(), items.end(), [](const auto& a, const auto& b) { return a.number < b.number; });
  for (std::size_t i = 1; i < items.size(); ++i)
    if (items[i].number == items[i - 1].number && diagnostics.errors().size() < most_model_errors)
      diagnostics.error({file, 0, 0}, fmt::format("{} {} is there twice", what, items[i].number), "number each one apart");
}

}  // namespace

void finish(Model& model, const std::string& file, input::Diagnostics& diagnostics) {
  sort_by_number(model.nodes, "node", file, diagnostics);
  sort_by_number(model.elements, "element", file, diagnostics);
  if (model.elements.empty() && !diagnostics.any())
    diagnostics.error({file, 0, 0}, "there are no elements in it",
                      "give a model with elements: NBLOCK and EBLOCK, N and E, K and A, or *NODE and *ELEMENT");
  if (diagnostics.any()) return;  // what was not read may be what is missed below
  NodeCheck check(model, file, diagnostics);
  std::unordered_set<int> elements;
  for (const ModelElement& element : model.elements) {
    elements.insert(element.number);
    for (std::size_t n = 0; n < element.nodes.size(); ++n)
      if (element.nodes[n] != 0 || static_cast<int>(n) < corner_count(element.kind))
        check(element.nodes[n], model.line_of(element.number), fmt::format("element {}", element.number));
  }
  for (const ModelSupport& support : model.supports) check(support.node, 0, "a support");
  for (const ModelObliqueSupport& support : model.oblique_supports) check(support.node, 0, "a support");
  for (const ModelForce& force : model.forces) check(force.node, 0, "a force");
  for (const ModelPressure& pressure : model.pressures)
    if (!elements.contains(pressure.element) && diagnostics.errors().size() < most_model_errors)
      diagnostics.error({file, 0, 0}, fmt::format("a pressure acts on element {}, which is not there", pressure.element),
                        "give the element, or leave the pressure out");
  for (auto& [name, nodes] : model.node_sets) {
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    for (const int node : nodes) check(node, 0, "the set " + name);
  }
}

void tell_load_step(Model& model, int steps, int asked, const input::Location& last, input::Diagnostics& diagnostics) {
  if (asked > std::max(1, steps))
    return diagnostics.error(last, fmt::format("load step {} is asked for, and there {} {}", asked, steps == 1 ? "is" : "are", steps),
                             steps > 1 ? fmt::format("write load_step from 1 to {} in [body]", steps) : "leave load_step out of [body]");
  if (steps < 2) return;
  if (asked > 0)
    model.remarks.push_back({last, fmt::format("there are {} steps: the loads and supports at the end of step {} are brought up together", steps, asked), "load_step in [body] chooses it"});
  else
    model.remarks.push_back({last, fmt::format("there are {} steps: the loads and supports at the end of the last one are brought up together", steps),
                             "load_step in [body] chooses another"});
}

input::Diagnostic linear_step_remark(const std::string& file, const std::string& switch_on, int line) {
  return {{file, line, 1}, "the step is one of small displacements there, and is solved with large ones here",
          "the answers agree only while strains and turns are small; " + switch_on + " in the file has both alike"};
}

/// Both programs call their input .inp: cards of CalculiX begin with one star and a letter.
static bool looks_like_calculix(std::string_view text) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = trimmed(text.substr(0, end));
    if (!line.empty() && !line.starts_with("**")) return line.starts_with("*");
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return false;
}

bool is_model_file(const std::filesystem::path& file) {
  const std::string ending = upper_case(file.extension().string());
  for (const char* known : {".CDB", ".ANS", ".MAC", ".APDL", ".TXT", ".INP", ".FEB"})
    if (ending == known) return true;
  return false;
}

Model read_model(const std::filesystem::path& file, const std::filesystem::path& root, int load_step) {
  std::string text = input::read_file(file);
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);  // a mark that editors of Windows put before UTF-8
  input::Diagnostics diagnostics;
  const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
  Model model = upper_case(file.extension().string()) == ".FEB" ? parse_febio(text, file.string(), diagnostics, load_step)
                : looks_like_calculix(text) ? parse_calculix(text, file.string(), diagnostics, folder, root.empty() ? folder : root, load_step)
                                          : parse_apdl(text, file.string(), diagnostics, load_step);
  diagnostics.throw_if_any();
  return model;
}

}  // namespace snug::mesh
