#include "cases/input/spreadsheet.hpp"

#include <fmt/format.h>
#include <zip.h>

#include <algorithm>
#include <charconv>
#include <memory>
#include <optional>
#include <pugixml.hpp>

namespace snug::input {

namespace {

constexpr zip_uint64_t largest_part = zip_uint64_t{1} << 28;                        // bytes, unpacked
constexpr std::size_t most_columns = 16384, most_rows = 1048576, most_cells = 5'000'000;  // the first two are Excel's
constexpr std::size_t most_faults = 20;

struct Discard {
  void operator()(zip_t* archive) const { zip_discard(archive); }
  void operator()(zip_file_t* part) const { zip_fclose(part); }
};

/// The parts of a zip file in memory.
class Parts {
 public:
  explicit Parts(std::string_view bytes) {
    zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, nullptr);
    if (!source) return;
    archive_.reset(zip_open_from_source(source, ZIP_RDONLY, nullptr));
    if (!archive_) zip_source_free(source);
  }
  bool open() const { return archive_ != nullptr; }
  bool has(const std::string& name) const { return zip_name_locate(archive_.get(), name.c_str(), ZIP_FL_NOCASE) >= 0; }

  /// Nothing where it is missing, cannot be unpacked or is too long.
  std::optional<std::string> read(const std::string& name) const {
    zip_stat_t stat;
    zip_stat_init(&stat);
    if (zip_stat(archive_.get(), name.c_str(), ZIP_FL_NOCASE, &stat) != 0 || !(stat.valid & ZIP_STAT_SIZE) || stat.size > largest_part) return std::nullopt;
    const std::unique_ptr<zip_file_t, Discard> part(zip_fopen(archive_.get(), name.c_str(), ZIP_FL_NOCASE));
    if (!part) return std::nullopt;
    std::string text(stat.size, '\0');
    char more = 0;  // reading on to the end checks the sum
    if (zip_fread(part.get(), text.data(), stat.size) != static_cast<zip_int64_t>(stat.size) || zip_fread(part.get(), &more, 1) != 0) return std::nullopt;
    return text;
  }

 private:
  std::unique_ptr<zip_t, Discard> archive_;
};

/// The name behind a prefix, "x:row".
std::string_view local(const char* name) {
  const std::string_view text = name;
  const auto colon = text.find(':');
  return colon == text.npos ? text : text.substr(colon + 1);
}

pugi::xml_node child(const pugi::xml_node& node, std::string_view name) {
  return node.find_child([&](const pugi::xml_node& one) { return local(one.name()) == name; });
}

/// The text of an item with its runs; how it is pronounced (rPh) is none of it.
std::string text_of(const pugi::xml_node& item) {
  std::string text;
  for (const pugi::xml_node& one : item.children()) {
    if (local(one.name()) == "t") text += one.text().get();
    if (local(one.name()) == "r") text += child(one, "t").text().get();
  }
  return text;
}

/// Column of "BC7", from 0; nothing where it is no name of a cell.
std::optional<std::size_t> column_of(std::string_view cell) {
  std::size_t column = 0, letters = 0;
  while (letters < cell.size() && cell[letters] >= 'A' && cell[letters] <= 'Z' && letters < 4) column = 26 * column + (cell[letters++] - 'A' + 1);
  return letters == 0 || letters > 3 || column > most_columns ? std::nullopt : std::optional(column - 1);
}

std::string cell_name(std::size_t column, int row) {
  std::string letters;
  for (std::size_t c = column + 1; c > 0; c = (c - 1) / 26) letters.insert(letters.begin(), static_cast<char>('A' + (c - 1) % 26));
  return fmt::format("{}{}", letters, row);
}

class Workbook {
 public:
  Workbook(const Parts& parts, const std::string& file, Diagnostics& diagnostics) : parts_(parts), file_(file), diagnostics_(diagnostics) {}

  std::vector<SheetRow> rows() {
    const std::optional<std::string> sheet = first_sheet();
    if (!sheet || !read_strings()) return {};
    pugi::xml_document document;
    if (!parse(*sheet, document)) return {};
    for (const pugi::xml_node& row : child(document.first_child(), "sheetData").children()) {
      if (local(row.name()) != "row") continue;
      if (rows_.size() >= most_rows || cells_ > most_cells) return too_large();
      add(row);
    }
    return std::move(rows_);
  }

 private:
  std::vector<SheetRow> too_large() {
    fault("the sheet is larger than a table of girths or of tests is", "save what is needed of it in a file of its own");
    return {};
  }
  void fault(std::string found, std::string remedy) {
    if (diagnostics_.errors().size() < most_faults) diagnostics_.error({file_, 0, 0}, std::move(found), std::move(remedy));
  }

  bool parse(const std::string& name, pugi::xml_document& document) {
    const std::optional<std::string> text = parts_.read(name);
    if (text && document.load_buffer(text->data(), text->size())) return true;
    fault(fmt::format("the part {} of the workbook cannot be read", name), "open it in the spreadsheet program and save it again, or save the sheet as CSV");
    return false;
  }

  /// Name of the part that a relation of the workbook leads to.
  std::optional<std::string> target(std::string_view id) {
    pugi::xml_document relations;
    if (!parse("xl/_rels/workbook.xml.rels", relations)) return std::nullopt;
    for (const pugi::xml_node& one : relations.first_child().children()) {
      if (id != one.attribute("Id").value()) continue;
      const std::string to = one.attribute("Target").value();
      return to.starts_with("/") ? to.substr(1) : "xl/" + to;
    }
    fault("the workbook does not say where its first sheet is", "open it in the spreadsheet program and save it again, or save the sheet as CSV");
    return std::nullopt;
  }

  std::optional<std::string> first_sheet() {
    pugi::xml_document book;
    if (!parse("xl/workbook.xml", book)) return std::nullopt;
    const pugi::xml_node sheet = child(child(book.first_child(), "sheets"), "sheet");
    for (const pugi::xml_attribute& one : sheet.attributes())
      if (local(one.name()) == "id" && one.name() != std::string_view("id")) return target(one.value());
    fault("the workbook has no sheet", "save the table as the first sheet, or as CSV");
    return std::nullopt;
  }

  bool read_strings() {
    if (!parts_.has("xl/sharedStrings.xml")) return true;
    pugi::xml_document document;
    if (!parse("xl/sharedStrings.xml", document)) return false;
    for (const pugi::xml_node& item : document.first_child().children())
      if (local(item.name()) == "si") strings_.push_back(text_of(item));
    return true;
  }

  void add(const pugi::xml_node& row) {
    SheetRow to{row.attribute("r").as_int(rows_.empty() ? 1 : rows_.back().number + 1), {}};
    for (const pugi::xml_node& cell : row.children()) {
      if (local(cell.name()) != "c") continue;
      const std::string_view name = cell.attribute("r").value();
      const std::size_t column = column_of(name).value_or(to.cells.size());
      if (column >= most_columns || (cells_ += column >= to.cells.size() ? column + 1 - to.cells.size() : 0) > most_cells) break;
      if (column >= to.cells.size()) to.cells.resize(column + 1);
      to.cells[column] = value_of(cell, column, to.number);
    }
    rows_.push_back(std::move(to));
  }

  std::string value_of(const pugi::xml_node& cell, std::size_t column, int row) {
    const std::string_view type = cell.attribute("t").value();
    const pugi::xml_node value = child(cell, "v");
    if (type == "inlineStr") return text_of(child(cell, "is"));
    if (!value && child(cell, "f")) {
      fault(fmt::format("the formula in {} has no value", cell_name(column, row)), "open the file in the spreadsheet program, let it compute, and save it; or write the value");
      return "";
    }
    const std::string text = value.text().get();
    if (type == "e") fault(fmt::format("there is {} in {}", text, cell_name(column, row)), "correct the formula, or write the value");
    if (type != "s") return text;
    std::size_t index = 0;
    const auto parsed = std::from_chars(text.data(), text.data() + text.size(), index);
    if (parsed.ec == std::errc() && index < strings_.size()) return strings_[index];
    fault(fmt::format("the text of {} is missing in the workbook", cell_name(column, row)), "open it in the spreadsheet program and save it again, or save the sheet as CSV");
    return "";
  }

  const Parts& parts_;
  const std::string& file_;
  Diagnostics& diagnostics_;
  std::vector<std::string> strings_;
  std::vector<SheetRow> rows_;
  std::size_t cells_ = 0;
};

}  // namespace

bool is_zip(std::string_view bytes) { return bytes.starts_with("PK\x03\x04"); }

std::vector<SheetRow> sheet_rows(std::string_view bytes, const std::string& shown_as, Diagnostics& diagnostics) {
  const Parts parts(bytes);
  if (!parts.open() || !parts.has("xl/workbook.xml")) {
    diagnostics.error({shown_as, 0, 0}, "this is neither a table as text nor an .xlsx workbook", "save its sheet as .xlsx, or as CSV (separated by commas, semicolons or tabs)");
    return {};
  }
  return Workbook(parts, shown_as, diagnostics).rows();
}

}  // namespace snug::input
