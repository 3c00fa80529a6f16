#include "postproc/nodal_field.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <unordered_map>

#include "postproc/field_cells.hpp"
#include "postproc/store.hpp"
#include "postproc/stress.hpp"

namespace snug::postproc {

namespace fs = std::filesystem;

namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

bool is_coordinate(const std::string& label) { return label == "X" || label == "Y" || label == "Z"; }

std::string surface_name(ShellSurface surface) {
  switch (surface) {
    case ShellSurface::top:
      return " TOP";
    case ShellSurface::middle:
      return " MIDDLE";
    case ShellSurface::bottom:
      return " BOTTOM";
    case ShellSurface::none:
      break;
  }
  return "";
}

/// Sums for the mean of each node.
struct Column {
  std::vector<double> sums;
  std::vector<int> counts;
};

/// Gathers the rows of tables, column by column.
class Gather {
 public:
  Gather(const std::vector<ListingTable>& tables, const FieldOptions& options) : options_(options) {
    for (const ListingTable& table : tables)
      if (!options.load_step || table.load_step == *options.load_step) last_step_ = std::max(last_step_, step_of(table));
    note_steps(tables);
    for (const ListingTable& table : tables) has_values_ |= counts(table) && !only_places(table);
    for (const ListingTable& table : tables)
      if (counts(table) && !(has_values_ && only_places(table)))
        for (const ListingRow& row : table.rows)
          if (wanted(row)) nodes_.push_back(row.node);
    std::sort(nodes_.begin(), nodes_.end());
    nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
    index_.reserve(nodes_.size());
    for (std::size_t n = 0; n < nodes_.size(); ++n) index_[nodes_[n]] = n;
    for (const ListingTable& table : tables)
      if (counts(table)) add(table);
  }

  NodalField field() && {
    NodalField field;
    field.nodes = std::move(nodes_);
    for (const std::string& label : order_) {
      const Column& column = columns_.at(label);
      NodalColumn& to = field.columns.emplace_back(NodalColumn{label, {}});
      to.values.resize(field.nodes.size(), no_value);
      for (std::size_t n = 0; n < to.values.size(); ++n)
        if (column.counts[n] > 0) to.values[n] = column.sums[n] / column.counts[n] * unit(label);
    }
    move_places(field);
    field.notes = std::move(notes_);
    return field;
  }

 private:
  static std::pair<int, int> step_of(const ListingTable& table) { return {table.load_step, table.substep}; }
  /// Tables of an earlier load step do not count; NLIST belongs to all of them.
  bool counts(const ListingTable& table) const { return table.load_step == 0 || step_of(table) == last_step_; }
  /// Nodes of which nothing but the place is known are nothing to compare.
  static bool only_places(const ListingTable& table) {
    return table.kind == "NODES" || std::all_of(table.labels.begin(), table.labels.end(), is_coordinate);
  }
  bool wanted(const ListingRow& row) const {
    return !options_.surface || row.surface == ShellSurface::none || row.surface == *options_.surface;
  }
  double unit(const std::string& label) const {
    const Quantity quantity = quantity_of(label);
    return quantity == Quantity::stress  ? options_.stress_unit
           : quantity == Quantity::other ? 1.0
                                         : options_.length_unit;
  }

  void note_steps(const std::vector<ListingTable>& tables) {
    std::set<std::pair<int, int>> steps;
    for (const ListingTable& table : tables)
      if (table.load_step > 0) steps.insert(step_of(table));
    const auto text = [](const std::pair<int, int>& step) { return fmt::format("load step {} substep {}", step.first, step.second); };
    if (options_.load_step && !steps.empty() && last_step_.first != *options_.load_step)
      throw input::InputError({"the listing", 0, 0}, fmt::format("there is no load step {} in it", *options_.load_step),
                              "the last one is " + text(*steps.rbegin()) + ": --load-step of compare, load_step in [reference]");
    if (steps.size() > 1)
      notes_.push_back(fmt::format("of {} load steps and substeps, {} is taken{}", steps.size(), text(last_step_), options_.load_step ? "" : "; --load-step (load_step in [reference]) takes another"));
  }

  /// Components of a cylindrical frame are no Cartesian ones; sums, principal and equivalent values are the same in all frames.
  static bool is_component(const std::string& label) {
    static const std::set<std::string> components = {"X", "Y", "Z", "UX", "UY", "UZ", "SX", "SY", "SZ", "SXY", "SYZ", "SXZ", "ROTX", "ROTY", "ROTZ"};
    return components.contains(label);
  }
  bool left_out(const ListingTable& table, const std::string& label) {
    if (table.frame.empty() || !is_component(label)) return false;
    const std::string note = fmt::format("its components are in {} and not compared: print them with RSYS,0 (places with DSYS,0)", table.frame);
    if (std::find(notes_.begin(), notes_.end(), note) == notes_.end()) notes_.push_back(note);
    return true;
  }

  void add(const ListingTable& table) {
    bool top = false, bottom = false;
    for (const ListingRow& row : table.rows) {
      top |= row.surface == ShellSurface::top;
      bottom |= row.surface == ShellSurface::bottom;
    }
    const bool name_surfaces = top && bottom && !options_.surface;
    for (std::size_t c = 0; c < table.labels.size(); ++c) {
      if (table.kind == "NODES" && !is_coordinate(table.labels[c])) continue;  // rotations of nodal frames
      if (left_out(table, table.labels[c])) continue;
      for (const ShellSurface surface :
           {ShellSurface::none, ShellSurface::top, ShellSurface::middle, ShellSurface::bottom})
        add_column(table, c, surface, table.labels[c] + (name_surfaces ? surface_name(surface) : ""));
    }
  }

  void add_column(const ListingTable& table, std::size_t c, ShellSurface surface, const std::string& label) {
    Column* column = nullptr;
    for (std::size_t r = 0; r < table.rows.size(); ++r) {
      const ListingRow& row = table.rows[r];
      if (row.surface != surface || !wanted(row)) continue;
      if (!column) column = &column_of(label);
      const auto n = index_.find(row.node);
      if (n == index_.end()) continue;
      const double own_unit = table.factors.empty() || table.factors[c] == 0.0 ? 1.0 : table.factors[c] / unit(table.labels[c]);
      column->sums[n->second] += table.value(r, c) * own_unit;
      ++column->counts[n->second];
    }
  }

  Column& column_of(const std::string& label) {
    const auto [place, added] = columns_.try_emplace(label);
    if (added) {
      order_.push_back(label);
      place->second.sums.resize(nodes_.size(), 0.0);
      place->second.counts.resize(nodes_.size(), 0);
    }
    return place->second;
  }

  /// X Y Z are the places of the nodes, not values to compare.
  static void move_places(NodalField& field) {
    const NodalColumn *x = field.find("X"), *y = field.find("Y"), *z = field.find("Z");
    if (!x || !y || !z) return;
    for (std::size_t n = 0; n < field.nodes.size(); ++n)
      field.places.emplace_back(x->values[n], y->values[n], z->values[n]);
    std::erase_if(field.columns, [](const NodalColumn& column) { return is_coordinate(column.label); });
  }

  const FieldOptions& options_;
  std::pair<int, int> last_step_ = {0, 0};
  std::vector<std::string> notes_;
  bool has_values_ = false;
  std::vector<int> nodes_;
  std::unordered_map<int, std::size_t> index_;
  std::map<std::string, Column> columns_;
  std::vector<std::string> order_;
};

void append(std::vector<ListingTable>& to, std::vector<ListingTable> from) {
  for (ListingTable& table : from) to.push_back(std::move(table));
}

NodalField read_listings(const fs::path& source, const std::vector<fs::path>& files, const FieldOptions& options) {
  std::vector<ListingTable> tables;
  for (const fs::path& file : files) append(tables, read_listing(file));
  if (!options.nodes.empty()) append(tables, read_listing(options.nodes));
  NodalField field = field_of(tables, options);
  if (field.columns.empty() && field.places.empty() && !field.notes.empty())
    throw input::InputError({source.string(), 0, 0}, "nothing in it can be compared: " + field.notes.back(), "give a listing in the global Cartesian frame");
  if (field.nodes.empty())
    throw input::InputError({source.string(), 0, 0}, "its tables have no rows for the surface asked for",
                            "leave the surface out, or name one that the listing has");
  return field;
}

NodalField read_nodal_grid(const fs::path& vtu, std::optional<ShellSurface> surface) {
  return nodal_field(read_grid(vtu), vtu.string(), surface);
}

NodalField read_directory(const fs::path& directory, const FieldOptions& options) {
  if (fs::exists(directory / body_grid_file)) return read_nodal_grid(directory / body_grid_file, options.surface);
  std::vector<fs::path> files;
  for (const char* name : {"displacement.lis", "stress.lis", "nodes.lis"})
    if (fs::exists(directory / name)) files.push_back(directory / name);
  if (files.empty())
    throw input::InputError(
        {directory.string(), 0, 0}, "there are no results in this directory",
        "name one with body_0000.vtu or with displacement.lis, stress.lis and nodes.lis, or a file");
  return read_listings(directory, files, options);
}

}  // namespace

Quantity quantity_of(const std::string& label) {
  const std::string plain = label.substr(0, label.find(' '));
  for (const char* name : {"UX", "UY", "UZ", "USUM"})
    if (plain == name) return Quantity::displacement;
  for (const char* name : {"S1", "S2", "S3", "SINT", "SEQV", "SX", "SY", "SZ", "SXY", "SYZ", "SXZ"})
    if (plain == name) return Quantity::stress;
  return is_coordinate(plain) ? Quantity::coordinate : Quantity::other;
}

std::string unit_of(Quantity quantity) {
  return quantity == Quantity::stress ? "Pa" : quantity == Quantity::other ? "" : "m";
}

const NodalColumn* NodalField::find(const std::string& label) const {
  const auto found =
      std::find_if(columns.begin(), columns.end(), [&](const NodalColumn& column) { return column.label == label; });
  return found == columns.end() ? nullptr : &*found;
}

NodalField field_of(const std::vector<ListingTable>& tables, const FieldOptions& options) {
  return Gather(tables, options).field();
}

void set_invariants(NodalField& field) {
  const std::size_t count = field.nodes.size();
  const auto values = [&](const std::string& label) -> const std::vector<double>* {
    const NodalColumn* column = field.find(label);
    return column ? &column->values : nullptr;
  };
  const auto set = [&](const std::string& label, const auto& value) {
    std::vector<double> all(count);
    for (std::size_t n = 0; n < count; ++n) all[n] = value(n);
    if (auto* column = const_cast<NodalColumn*>(field.find(label)))
      column->values = std::move(all);
    else
      field.columns.push_back({label, std::move(all)});
  };
  if (values("UX") && values("UY") && values("UZ"))
    set("USUM", [&](std::size_t n) {
      return Eigen::Vector3d((*values("UX"))[n], (*values("UY"))[n], (*values("UZ"))[n]).norm();
    });
  for (const std::string surface : {"", " TOP", " BOTTOM"}) {
    std::array<std::string, 6> components = {"SX", "SY", "SZ", "SXY", "SYZ", "SXZ"};
    for (std::string& component : components) component += surface;
    if (!std::all_of(components.begin(), components.end(), values)) continue;
    std::vector<Stress> stress(count);
    for (int c = 0; c < 6; ++c)
      for (std::size_t n = 0; n < count; ++n) stress[n][c] = (*values(components[c]))[n];
    std::vector<Eigen::Vector3d> principal(count, Eigen::Vector3d::Constant(no_value));
    for (std::size_t n = 0; n < count; ++n)
      if (stress[n].allFinite()) principal[n] = principal_stresses(stress[n]);
    set("S1" + surface, [&](std::size_t n) { return principal[n][0]; });
    set("S2" + surface, [&](std::size_t n) { return principal[n][1]; });
    set("S3" + surface, [&](std::size_t n) { return principal[n][2]; });
    set("SINT" + surface, [&](std::size_t n) { return stress_intensity(principal[n]); });
    set("SEQV" + surface, [&](std::size_t n) { return von_mises(stress[n]); });
  }
}

NodalField read_field(const fs::path& source, const FieldOptions& options) {
  NodalField field = fs::is_directory(source)       ? read_directory(source, options)
                     : source.extension() == ".vtu" ? read_nodal_grid(source, options.surface)
                                                    : read_listings(source, {source}, options);
  field.name = source.string();
  return field;
}

}  // namespace snug::postproc
