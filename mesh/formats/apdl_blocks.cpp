#include <fmt/format.h>

#include <algorithm>

#include "mesh/formats/apdl_deck.hpp"

namespace snug::mesh {

bool LineSource::next(std::string_view& line) {
  if (rest_.empty()) return false;
  const std::size_t end = std::min(rest_.find('\n'), rest_.size());
  line = rest_.substr(0, end);
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  rest_.remove_prefix(std::min(end + 1, rest_.size()));
  ++number_;
  return true;
}

FixedColumns fixed_columns(std::string_view format) {
  FixedColumns columns;
  const std::string_view inside = trimmed(format);
  if (inside.size() < 3 || inside.front() != '(' || inside.back() != ')') return {};
  for (const TextField& field : fields_of(inside.substr(1, inside.size() - 2))) {
    const auto letter = field.text.find_first_of("iIeEgGfFaA");
    if (letter == field.text.npos) return {};
    const int repeat = letter == 0 ? 1 : integer_of(field.text.substr(0, letter)).value_or(0);
    const std::string_view size = field.text.substr(letter + 1);
    const int width = integer_of(size.substr(0, size.find_first_not_of("0123456789"))).value_or(0);
    if (repeat < 1 || repeat > 100 || width < 1 || width > 100) return {};
    for (int n = 0; n < repeat; ++n) {
      columns.widths.push_back(width);
      columns.integer.push_back(field.text[letter] == 'i' || field.text[letter] == 'I');
    }
  }
  return columns;
}

namespace {

/// Cuts lines at fixed columns; blank columns and those past the end are blank fields.
FieldLine cut(std::string_view line, int number, const FixedColumns& columns, const FieldLine& head) {
  FieldLine row{head.file, number, {}, head.diagnostics};
  std::size_t begin = 0;
  for (const int width : columns.widths) {
    if (begin >= line.size()) break;
    row.fields.push_back({trimmed(line.substr(begin, width)), static_cast<int>(begin) + 1});
    begin += width;
  }
  return row;
}

/// The format line of a block, or nothing and an error.
FixedColumns format_of(const FieldLine& head, LineSource& lines) {
  std::string_view line;
  FixedColumns columns;
  if (lines.next(line)) columns = fixed_columns(line);
  if (columns.widths.empty())
    head.diagnostics.error({head.file, lines.number(), 1}, fmt::format("\"{}\" is no format of columns", trimmed(line).substr(0, 30)),
                           "put the Fortran format there, e.g. (3i9,6e21.13e3)");
  return columns;
}

bool is_end(std::string_view line) {
  const std::string_view text = trimmed(line);
  return text == "-1" || text.starts_with("N,") || text.starts_with("n,");
}

}  // namespace

void set_frame(ApdlDeck& deck, int node, double thxy, double thyz, double thzx) {
  deck.frames.erase(node);
  if (thxy != 0.0 || thyz != 0.0 || thzx != 0.0) deck.frames[node] = frame_of_angles(thxy, thyz, thzx);
}

void set_key_option(const FieldLine& line, ApdlDeck& deck, int type, int option, std::size_t field) {
  const int value = line.integer_at(field), ename = deck.types.contains(type) ? deck.types.at(type) : 0;
  if (value != 0) deck.options[type][option] = value;
  const bool shell = ename == 63 || ename == 181 || ename == 281 || ename == 93;
  if (shell && option == 1 && value != 0)
    line.error(field, "the shell is a membrane without bending, or bends without stretching", "leave the key option 1 at 0");
  if (ename == 154 && option != 4 && value != 0)
    line.error(field, fmt::format("key option {} of SURF154 is {}", option, value), "pressures are read that act along the normal of SURF154: leave its key options at 0, but for (4)");
}

namespace {

void read_nodes(const FieldLine& head, LineSource& lines, ApdlDeck& deck) {
  const FixedColumns columns = format_of(head, lines);
  const auto first_real = std::find(columns.integer.begin(), columns.integer.end(), 0) - columns.integer.begin();
  if (columns.widths.empty()) return;
  for (std::string_view line; lines.next(line) && !is_end(line);) {
    if (trimmed(line).empty()) continue;
    const FieldLine row = cut(line, lines.number(), columns, head);
    const int number = row.integer_at(0);
    if (number < 1) row.error(0, fmt::format("\"{}\" is no node number", row.text(0)), "nodes count from 1");
    Eigen::Vector3d at;
    for (int c = 0; c < 3; ++c) at[c] = row.number_at(first_real + c);
    deck.nodes[number] = at;
    set_frame(deck, number, row.number_at(first_real + 3), row.number_at(first_real + 4), row.number_at(first_real + 5));
    if (head.diagnostics.errors().size() > most_model_errors) return;
  }
}

void read_elements(const FieldLine& head, LineSource& lines, ApdlDeck& deck) {
  const FixedColumns columns = format_of(head, lines);
  if (columns.widths.empty()) return;
  if (upper_case(head.text(2)) != "SOLID")
    return head.error(2, "this EBLOCK has not the layout SOLID", "write the file with CDWRITE (blocked format)");
  for (std::string_view line; lines.next(line) && !is_end(line);) {
    if (trimmed(line).empty()) continue;
    FieldLine row = cut(line, lines.number(), columns, head);
    ApdlElement element{row.integer_at(10), row.integer_at(1), row.integer_at(0), row.integer_at(2), row.integer_at(3), {}, row.number};
    const int count = row.integer_at(8);
    if (row.fields.size() < 11 || count < 1 || count > 20) {
      row.error(8, "this is no element of an EBLOCK with 19 columns", "give MAT, TYPE, REAL, SECNUM, ..., the number of nodes, ..., the element and its nodes");
      return;
    }
    std::size_t field = 11;
    while (static_cast<int>(element.nodes.size()) < count) {
      if (field >= row.fields.size()) {
        if (field == 11 || !lines.next(line) || is_end(line)) {
          row.error(8, fmt::format("element {} has {} nodes where {} are announced", element.number, element.nodes.size(), count),
                    "complete its line");
          return;
        }
        row.fields = cut(line, lines.number(), columns, head).fields, row.number = lines.number(), field = 0;
        if (row.fields.empty()) row.fields.push_back({});
      }
      element.nodes.push_back(row.integer_at(field++));
    }
    deck.elements.push_back(std::move(element));
    if (head.diagnostics.errors().size() > most_model_errors) return;
  }
}

/// CMBLOCK,NAME,NODE|ELEM,count: -m closes a range from the entry before it.
void read_component(const FieldLine& head, LineSource& lines, ApdlDeck& deck) {
  const FixedColumns columns = format_of(head, lines);
  const std::string kind = upper_case(head.text(2));
  const int count = integer_of(head.text(3).substr(0, head.text(3).find_first_not_of("0123456789"))).value_or(0);
  if (columns.widths.empty()) return;
  std::vector<int> items;
  int read = 0;
  for (std::string_view line; read < count && lines.next(line);) {
    const FieldLine row = cut(line, lines.number(), columns, head);
    for (std::size_t f = 0; f < row.fields.size() && read < count; ++f, ++read) {
      const int item = row.integer_at(f);
      const bool range = item < 0 && !items.empty() && -item > items.back() && -item - items.back() < 100'000'000;
      if (item == 0 || (item < 0 && !range))
        return row.error(f, fmt::format("\"{}\" is no member of a component", row.text(f)), "give numbers; -m closes a range");
      if (item > 0) items.push_back(item);
      const long known = static_cast<long>(kind == "NODE" ? deck.nodes.size() : deck.elements.size());
      if (range && -item - items.back() > 10 * known + 1000)
        return row.error(f, "the range is far larger than the model", "correct its end");
      while (range && items.back() < -item) items.push_back(items.back() + 1);
    }
  }
  const std::string name = upper_case(head.text(1));
  if (kind == "NODE") {  // a range may run over numbers that are not used
    std::erase_if(items, [&](int node) { return !deck.nodes.empty() && !deck.nodes.contains(node); });
    deck.node_sets[name] = items;
  }
  if (kind.starts_with("ELEM")) deck.element_sets[name] = items;
}

/// Two formats; a line with set number, count and the first values, the rest on the next lines.
void read_reals(const FieldLine& head, LineSource& lines, ApdlDeck& deck) {
  const FixedColumns first = format_of(head, lines), more = format_of(head, lines);
  if (first.widths.empty() || more.widths.empty()) return;
  std::string_view line;
  for (int set = head.integer_at(1); set > 0 && lines.next(line); --set) {
    FieldLine row = cut(line, lines.number(), first, head);
    const int number = row.integer_at(0), count = std::clamp(row.integer_at(1), 0, 1000);
    std::vector<double>& values = deck.reals[number];
    values.clear();
    for (std::size_t f = 2; static_cast<int>(values.size()) < count; ++f) {
      if (f >= first.widths.size() || (f >= row.fields.size() && f >= more.widths.size())) {
        if (!lines.next(line)) return;
        row.fields = cut(line, lines.number(), more, head).fields, row.number = lines.number(), f = 0;
      }
      values.push_back(row.number_at(f));
    }
  }
}

void read_types(const FieldLine& head, LineSource& lines, ApdlDeck& deck) {
  const FixedColumns columns = format_of(head, lines);
  if (columns.widths.empty()) return;
  for (std::string_view line; lines.next(line) && !is_end(line);) {
    const FieldLine row = cut(line, lines.number(), columns, head);
    const int number = row.integer_at(0);
    deck.types[number] = row.integer_at(1);
    for (std::size_t f = 2; f < row.fields.size(); ++f) set_key_option(row, deck, number, static_cast<int>(f) - 1, f);
  }
}

}  // namespace

bool read_block(const FieldLine& head, LineSource& lines, ApdlDeck& deck) {
  const std::string name = upper_case(head.text(0));
  if (name == "NBLOCK") read_nodes(head, lines, deck);
  else if (name == "EBLOCK") read_elements(head, lines, deck);
  else if (name == "CMBLOCK") read_component(head, lines, deck);
  else if (name == "RLBLOCK") read_reals(head, lines, deck);
  else if (name == "ETBLOCK") read_types(head, lines, deck);
  else return false;
  return true;
}

}  // namespace snug::mesh
