#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

#include "mesh/formats/apdl_commands.hpp"
#include "mesh/formats/apdl_loads.hpp"
#include "mesh/formats/apdl_script.hpp"

namespace snug::mesh {

namespace {

class ApdlReader {
 public:
  ApdlReader(const std::string& text, const std::string& file, input::Diagnostics& diagnostics, int load_step)
      : source_(text), file_(file), diagnostics_(diagnostics), loads_(deck_, selection_, load_step) {}

  /// Of the text that has been read: load steps, and the line that ends the one that is taken.
  int steps() const { return loads_.steps(); }
  int step_line() const { return loads_.line(); }

  ApdlDeck read() {
    for (std::string_view line; source_.next(line) && diagnostics_.errors().size() < most_model_errors;) {
      line = line.substr(0, line.find('!'));
      for (std::size_t begin = 0; begin <= line.size();) {
        const std::size_t end = std::min(line.find('$', begin), line.size());
        command(fields_of(line.substr(begin, end - begin), static_cast<int>(begin)));
        begin = end + 1;
      }
    }
    script_.finish(file_, diagnostics_);
    check_temperature();
    return std::move(deck_);
  }

 private:
  void command(std::vector<TextField> fields) {
    if (fields.size() == 1 && fields[0].text.empty()) return;
    const FieldLine written{file_, source_.number(), std::move(fields), diagnostics_};
    const std::string name = short_name(written.text(0));
    if (script_.take(written, source_)) return;
    if (name.find_first_not_of(". ") == name.npos)
      return written.error(0, "lines are left out here", "give the whole model");
    if (name.starts_with("/")) {
      if (name.starts_with("/INP")) written.error(0, fmt::format("{} reads another file", name), "put its lines here");
      return;
    }
    if (says_nothing(name)) return;
    const FieldLine line{file_, written.number, script_.evaluated(written.fields), diagnostics_};
    if (read_block(line, source_, deck_) || loads_.take(name, line)) return;
    const auto& table = commands();
    if (const auto it = table.find(name); it != table.end()) return it->second(*this, line);
    if (const auto load = load_of_command(name)) return no_load(line, *load);
    line.error(0, fmt::format("the command \"{}\" is not read", line.text(0).substr(0, 20)),
               name.starts_with("*") ? "of the script language *SET, *DO and *IF are read; where it says nothing about the model leave it out, else "
                                       "write the meshed model out: CDWRITE,DB in Ansys does"
                                     : "leave it out if it says nothing about the model (snug reads ET MP TB R K A N E EN D F DK FK SFE NSEL and CDB blocks)");
  }

  /// Loads that are not read must be none.
  static void no_load(const FieldLine& line, const std::string& found) {
    for (std::size_t f = 1; f < line.fields.size(); ++f)
      if (const auto value = number_of(line.text(f)); value && *value != 0.0)
        return line.error(f, found, "leave it out here; weight is [load] gravity in case.toml");
  }

  using Handler = std::function<void(ApdlReader&, const FieldLine&)>;
  static const std::map<std::string, Handler>& commands() {
    using R = ApdlReader;
    using L = const FieldLine&;
    static const std::map<std::string, Handler> table = {
        {"ET", [](R& r, L l) { r.type(l); }},
        {"KEYO", [](R& r, L l) { r.key_option(l); }},
        {"MP", [](R& r, L l) { r.property_polynomial(l); }},
        {"MPDA", [](R& r, L l) { upper_case(l.text(1)).starts_with("R") ? r.property_table(l, 3) : r.property_table(l, 1); }},
        {"TB", [](R& r, L l) { r.hyperelastic(l); }},
        {"TBDA", [](R& r, L l) { r.table_data(l); }},
        {"R", [](R& r, L l) { r.real(l); }},
        {"RMOR", [](R& r, L l) { r.more_reals(l); }},
        {"SECT", [](R& r, L l) { r.section_type(l); }},
        {"SECD", [](R& r, L l) { if (r.section_ > 0) r.deck_.shell_sections[r.section_] = {l.number_at(1)}; }},
        {"SECB", [](R& r, L l) { r.section_block(l); }},
        {"SECO", [](R&, L l) { if (const auto w = upper_case(l.text(1)); !w.empty() && w != "MID") l.error(1, "the shell is off its nodes", "use secoffset,mid"); }},
        {"TYPE", [](R& r, L l) { r.now_.type = l.integer_at(1, 1); }},
        {"MAT", [](R& r, L l) { r.now_.material = l.integer_at(1, 1); }},
        {"REAL", [](R& r, L l) { r.now_.real = l.integer_at(1, 1); }},
        {"SECN", [](R& r, L l) { r.now_.section = l.integer_at(1, 1); }},
        {"SECC", [](R&, L l) { for (std::size_t f = 1; f < 5; ++f) if (l.number_at(f) != 0.0) l.error(f, "the transverse shear of the shell is set by hand", "leave SECCONTROLS out"); }},
        {"ARCT", [](R&, L l) { if (const auto w = upper_case(l.text(1)); !w.empty() && w != "OFF") l.error(1, "the arc length ends the step before its full load", "leave ARCTRM out"); }},
        {"CSYS", [](R& r, L l) { r.coordinates(l); }},
        {"NLGE", [](R& r, L l) { const auto w = upper_case(l.text(1)); r.deck_.large_displacements = w == "ON" || w == "1"; }},
        {"TREF", [](R& r, L l) { r.reference_ = l.number_at(1); }},
        {"TUNI", [](R& r, L l) { r.uniform_ = l.number_at(1); }},
        {"BFUN", [](R& r, L l) { if (number_of(l.text(2))) r.uniform_ = l.number_at(2); }},
        {"AATT", [](R& r, L l) { r.now_.material = l.integer_at(1, 1), r.now_.real = l.integer_at(2, 1), r.now_.type = l.integer_at(3, 1), r.now_.section = l.integer_at(5, 1); }},
        {"N", [](R& r, L l) { r.node(l); }},
        {"K", [](R& r, L l) { r.point(l, r.deck_.keypoints); }},
        {"A", [](R& r, L l) { r.area(l); }},
        {"E", [](R& r, L l) { r.element(l, 0); }},
        {"EN", [](R& r, L l) { upper_case(l.text(1)).starts_with("R5") ? r.coded_element(l) : r.element(l, l.integer_at(1)); }},
        {"EMOR", [](R& r, L l) { r.more_nodes(l); }},
        {"ESIZ", [](R& r, L l) { r.element_size(l); }},
        {"MSHA", [](R&, L l) { if (upper_case(l.text(2)) == "3D") l.error(2, "volumes are not meshed here", "write the meshed model with CDWRITE"); }},
        {"AMES", [](R&, L l) { if (upper_case(l.text(1)) != "ALL") l.error(1, "only all areas are meshed", "write amesh,all"); }},
        {"CM", [](R& r, L l) { r.selection_.make_component(l); }},
        {"NSEL", [](R& r, L l) { r.selection_.select(l, [&r](const Eigen::Vector3d& at) { return r.in_coordinates(at); }); }},
        {"CMSE", [](R& r, L l) { r.selection_.select_component(l); }},
        {"ALLS", [](R& r, L) { r.selection_.all(); }},
        {"ESEL", [](R&, L l) { if (upper_case(l.text(1)) != "ALL") l.error(1, "elements are selected", "write esel,all"); }},
        {"ASEL", [](R&, L l) { if (upper_case(l.text(1)) != "ALL") l.error(1, "areas are selected", "write asel,all"); }},
        {"KSEL", [](R&, L l) { if (upper_case(l.text(1)) != "ALL") l.error(1, "keypoints are selected", "write ksel,all"); }}};
    return table;
  }

  /// 0 Cartesian, 1 cylindrical about z; areas between curved lines are not meshed.
  void coordinates(const FieldLine& line) {
    cylindrical_ = line.integer_at(1) == 1;
    if (line.integer_at(1) != 0 && !cylindrical_)
      line.error(1, "the coordinate system is neither the global Cartesian nor the cylindrical one about z", "use csys,0 or csys,1");
  }
  Eigen::Vector3d in_coordinates(const Eigen::Vector3d& at) const {
    if (!cylindrical_) return at;
    return {at.head<2>().norm(), std::atan2(at.y(), at.x()) * 180.0 / std::numbers::pi, at.z()};
  }
  Eigen::Vector3d place(const FieldLine& line, std::size_t field) const {
    const Eigen::Vector3d at(line.number_at(field), line.number_at(field + 1), line.number_at(field + 2));
    if (!cylindrical_) return at;
    const double angle = at.y() * std::numbers::pi / 180.0;
    return {at.x() * std::cos(angle), at.x() * std::sin(angle), at.z()};
  }

  void type(const FieldLine& line) {
    const std::string name = upper_case(line.text(2));
    const auto digits = name.find_first_of("0123456789");
    const int ename = digits == name.npos ? 0 : integer_of(std::string_view(name).substr(digits)).value_or(0);
    if (ename == 0) return line.error(2, fmt::format("\"{}\" is no element", line.text(2)), "give its name, e.g. et,1,shell63");
    const int number = line.integer_at(1, 1);
    deck_.types[number] = ename;
    for (std::size_t f = 3; f < line.fields.size(); ++f) set_key_option(line, deck_, number, static_cast<int>(f) - 2, f);
  }
  void key_option(const FieldLine& line) { set_key_option(line, deck_, line.integer_at(1, 1), line.integer_at(2), 3); }

  ApdlMaterial& material(const FieldLine& line, int number) {
    ApdlMaterial& material = deck_.materials[number];
    if (material.line == 0) material.line = line.number;
    return material;
  }
  /// MP,EX,1,c0,c1,...: a polynomial in the temperature.
  void property_polynomial(const FieldLine& line) {
    if (!is_read(line, 1)) return;
    for (std::size_t f = 4; f < line.fields.size(); ++f)
      if (line.number_at(f) != 0.0) return line.error(f, fmt::format("{} depends on the temperature", upper_case(line.text(1))), "give one value: the body has one temperature");
    material(line, line.integer_at(2, 1)).properties[upper_case(line.text(1))] = line.number_at(3);
  }
  /// MPDATA,EX,1,place,c1,...: values of a table in the temperature, several lines where it is long (CDWRITE puts R5.0 and the count first).
  void property_table(const FieldLine& line, std::size_t label) {
    if (!is_read(line, label)) return;
    auto& properties = material(line, line.integer_at(label + 1, 1)).properties;
    const std::string name = upper_case(line.text(label));
    if (line.integer_at(label + 2, 1) <= 1) properties.erase(name);
    for (std::size_t f = label + 3; f < line.fields.size(); ++f) {
      if (line.empty(f)) continue;
      const auto [it, fresh] = properties.emplace(name, line.number_at(f));
      if (!fresh && it->second != line.number_at(f))
        return line.error(f, fmt::format("{} depends on the temperature: {} and {}", name, it->second, line.text(f)), "give one value: the body has one temperature");
    }
  }
  bool is_read(const FieldLine& line, std::size_t label) {
    static const std::set<std::string> read = {"EX", "PRXY", "NUXY", "DENS", "GXY"}, expansion = {"ALPX", "ALPY", "ALPZ", "CTEX", "THSX"},
        others = {"REFT", "KXX", "KYY", "KZZ", "C", "MU", "DAMP", "DMPR", "ALPD", "BETD", "RSVX", "MURX", "PERX", "EMIS", "HF", "ENTH"};
    const std::string name = upper_case(line.text(label));
    if (expansion.contains(name) && line.number_at(label + (label == 1 && short_name(line.text(0)) == "MP" ? 2 : 3)) != 0.0) expands_ = line.number;
    if (!read.contains(name) && !others.contains(name) && !expansion.contains(name))
      line.error(label, fmt::format("the property {} is not read", line.text(label)), "materials are isotropic: EX, PRXY (or NUXY) and DENS");
    return read.contains(name);
  }
  /// Warmer than at rest a material that expands would be strained.
  void check_temperature() const {
    if (expands_ > 0 && uniform_ && *uniform_ != reference_)
      diagnostics_.error({file_, expands_, 1}, fmt::format("the body is {} warmer than at rest and expands", *uniform_ - reference_), "leave the temperatures or the expansion out");
  }

  void hyperelastic(const FieldLine& line) {
    table_ = line.integer_at(2, 1);
    ApdlMaterial& material = this->material(line, table_);
    const std::string lab = upper_case(line.text(1)).substr(0, 4), option = upper_case(line.text(5));
    material.terms = std::clamp(line.integer_at(4, option.starts_with("MOON") ? 2 : 1), 1, 10);
    material.table.clear();
    material.elastic = lab == "ELAS" && (option.empty() || option.starts_with("ISOT") || option.starts_with("EX"));
    if (material.elastic) return check_one_temperature(line);
    material.hyperelastic = lab != "HYPE" ? ModelLaw::none : option.starts_with("NEO") ? ModelLaw::neo_hooke
                            : (option.starts_with("MOON") && material.terms == 2) || (option.starts_with("POLY") && material.terms == 1) ? ModelLaw::mooney_rivlin
                            : option.starts_with("YEOH") && material.terms <= 3 ? ModelLaw::yeoh
                            : option.starts_with("OGDE") ? ModelLaw::ogden : ModelLaw::none;
    if (material.hyperelastic == ModelLaw::none)
      line.error(1, "this table of a material is not read", "use TB,HYPER with NEO, MOONEY (2 parameters), YEOH or OGDEN, TB,ELASTIC with ISOT, or MP,EX and MP,PRXY");
    check_one_temperature(line);
  }
  static void check_one_temperature(const FieldLine& line) {
    if (line.integer_at(3, 1) > 1) line.error(3, "the table of the material depends on the temperature", "give it for one temperature");
  }
  void table_data(const FieldLine& line) {
    std::vector<double>& table = deck_.materials[table_].table;
    const int start = std::clamp(line.integer_at(1, 1), 1, 60);
    for (std::size_t f = 2; f < line.fields.size() && f < 62; ++f) {
      const std::size_t at = start + f - 3;
      if (table.size() <= at) table.resize(at + 1, 0.0);
      table[at] = line.number_at(f);
    }
  }

  void real(const FieldLine& line) {
    real_ = line.integer_at(1, 1);
    deck_.reals[real_].clear();
    append(line, 2);
  }
  void more_reals(const FieldLine& line) { append(line, 1); }
  void append(const FieldLine& line, std::size_t first) {
    std::vector<double>& values = deck_.reals[real_];
    values.resize((values.size() + 5) / 6 * 6, 0.0);  // six a command
    for (std::size_t f = first; f < std::min(line.fields.size(), first + 6); ++f) values.push_back(line.number_at(f));
  }

  void section_type(const FieldLine& line) {
    section_ = line.integer_at(1, 1);
    if (upper_case(line.text(2)) != "SHELL")
      line.error(2, "only sections of shells are read", "write sectype,1,shell and secdata,THICKNESS");
  }
  void section_block(const FieldLine& line) {
    std::string_view layer;
    if (line.integer_at(1) != 1) return line.error(1, "the shell has several layers", "use one layer");
    if (!source_.next(layer)) return;
    const FieldLine row{file_, source_.number(), fields_of(layer), diagnostics_};
    if (section_ > 0) deck_.shell_sections[section_] = {row.number_at(0)};
  }

  void point(const FieldLine& line, std::map<int, Eigen::Vector3d>& points) {
    const int number = line.empty(1) ? (points.empty() ? 1 : points.rbegin()->first + 1) : line.integer_at(1);
    if (number < 1) return line.error(1, fmt::format("\"{}\" is no number of a point", line.text(1)), "points count from 1");
    points[number] = place(line, 2);
  }
  /// N,number,x,y,z,THXY,THYZ,THZX; without blocks CDWRITE writes N,R5.3,LOC,number,,,x,y,z and N,R5.3,ANG,number,,,THXY,THYZ,THZX.
  void node(const FieldLine& line) {
    const std::string coded = upper_case(line.text(1));
    if (!coded.starts_with("R5") && coded != "UNBL") {
      point(line, deck_.nodes);
      const int number = line.empty(1) ? deck_.nodes.rbegin()->first : line.integer_at(1);
      return set_frame(deck_, number, line.number_at(5), line.number_at(6), line.number_at(7));
    }
    const int number = line.integer_at(3);
    if (number < 1) return;  // -1 ends them
    if (upper_case(line.text(2)) == "ANG") return set_frame(deck_, number, line.number_at(6), line.number_at(7), line.number_at(8));
    deck_.nodes[number] = {line.number_at(6), line.number_at(7), line.number_at(8)};
  }
  /// EN,R5.5,ATTR,count,MAT,TYPE,REAL,SECNUM,ESYS,number,... and EN,R5.5,NODE,,nodes, eight a line.
  void coded_element(const FieldLine& line) {
    if (upper_case(line.text(2)) == "ATTR") {
      if (line.integer_at(3) < 1) return;  // -1 ends them
      coded_count_ = static_cast<std::size_t>(std::clamp(line.integer_at(3), 1, 20));
      deck_.elements.push_back({line.integer_at(9), line.integer_at(5), line.integer_at(4), line.integer_at(6), line.integer_at(7), {}, line.number});
      last_element_ = std::max(last_element_, line.integer_at(9));
      return;
    }
    if (deck_.elements.empty()) return line.error(2, "there is no element to be continued", "write EN,R5.5,ATTR first");
    std::vector<int>& nodes = deck_.elements.back().nodes;
    for (std::size_t f = 4; f < line.fields.size() && nodes.size() < coded_count_; ++f) nodes.push_back(line.integer_at(f));
  }

  void area(const FieldLine& line) {
    if (cylindrical_) return line.error(0, "the area has sides along a circle", "define areas in csys,0");
    ApdlArea area{{}, now_.type, now_.material, now_.real, now_.section, line.number};
    for (std::size_t f = 1; f < line.fields.size(); ++f) area.corners.push_back(line.integer_at(f));
    const std::set<int> apart(area.corners.begin(), area.corners.end());
    if (area.corners.size() < 3 || area.corners.size() > 4 || apart.size() != area.corners.size())
      return line.error(1, "the area has not three or four keypoints", "divide it into triangles and quadrilaterals");
    deck_.areas.push_back(std::move(area));
  }

  void element(const FieldLine& line, int number) {
    ApdlElement element = now_;
    element.line = line.number;
    element.number = number > 0 ? number : last_element_ + 1;
    last_element_ = std::max(last_element_, element.number);
    for (std::size_t f = number > 0 ? 2 : 1; f < line.fields.size(); ++f) element.nodes.push_back(line.integer_at(f));
    deck_.elements.push_back(std::move(element));
  }
  void more_nodes(const FieldLine& line) {
    if (deck_.elements.empty() || deck_.elements.back().nodes.size() > 20)
      return line.error(0, "there is no element to be continued", "write E first");
    for (std::size_t f = 1; f < line.fields.size(); ++f) deck_.elements.back().nodes.push_back(line.integer_at(f));
  }

  void element_size(const FieldLine& line) {
    if (line.number_at(1) != 0.0) return line.error(1, "the size of elements is given as a length", "give divisions of a line: esize,,1");
    deck_.divisions = line.integer_at(2);
  }

  LineSource source_;
  const std::string& file_;
  input::Diagnostics& diagnostics_;
  ApdlDeck deck_;
  ApdlSelection selection_{deck_};
  ApdlLoads loads_;
  ApdlElement now_;  ///< attributes of the elements to come
  int last_element_ = 0, real_ = 1, section_ = 0, table_ = 1;
  bool cylindrical_ = false;
  std::size_t coded_count_ = 0;
  double reference_ = 0.0;        ///< temperature at rest
  std::optional<double> uniform_; ///< temperature
  int expands_ = 0;               ///< line of a coefficient of expansion
  ApdlScript script_;
};

}  // namespace

Model parse_apdl(const std::string& text, const std::string& shown_as, input::Diagnostics& diagnostics, int load_step) {
  ApdlReader reader(text, shown_as, diagnostics, load_step);
  ApdlDeck deck = reader.read();
  if (!diagnostics.any()) mesh_areas(deck, shown_as, diagnostics);
  Model model = model_of(deck, shown_as, diagnostics);
  tell_load_step(model, reader.steps(), load_step, {shown_as, reader.step_line(), reader.step_line() > 0 ? 1 : 0}, diagnostics);
  return model;
}

}  // namespace snug::mesh
