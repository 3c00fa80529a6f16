// Tables in the first sheet of .xlsx workbooks.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "cases/input/csv.hpp"
#include "cases/input/spreadsheet.hpp"

namespace snug::input {
namespace {

using testing::ElementsAre, testing::HasSubstr;
using Parts = std::vector<std::pair<std::string, std::string>>;

std::uint32_t checksum(const std::string& bytes) {  // CRC-32 of zip files
  std::uint32_t crc = ~0u;
  for (const unsigned char byte : bytes) {
    crc ^= byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ (crc & 1 ? 0xEDB88320u : 0u);
  }
  return ~crc;
}

std::string little(std::uint64_t value, int bytes) {
  std::string text;
  for (int b = 0; b < bytes; ++b) text += static_cast<char>(value >> (8 * b));
  return text;
}

/// A zip file whose parts are stored as they are (APPNOTE.TXT 4.3).
std::string zip_of(const Parts& parts) {
  std::string file, directory;
  for (const auto& [name, text] : parts) {
    const std::string about = little(20, 2) + little(0, 2) + little(0, 2) + little(0, 4) + little(checksum(text), 4) + little(text.size(), 4) + little(text.size(), 4) + little(name.size(), 2) + little(0, 2);
    directory += "PK\x01\x02" + little(20, 2) + about + little(0, 2) + little(0, 2) + little(0, 2) + little(0, 4) + little(file.size(), 4) + name;
    file += "PK\x03\x04" + about + name + text;
  }
  const std::size_t begin = file.size();
  return file + directory + "PK\x05\x06" + little(0, 4) + little(parts.size(), 2) + little(parts.size(), 2) + little(directory.size(), 4) + little(begin, 4) + little(0, 2);
}

/// A workbook with two sheets, of which the first in the book is not the first file; strings with runs, phonetics and entities.
std::string workbook(const std::string& cells) {
  const std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  return zip_of({{"[Content_Types].xml", xml + "<Types/>"},
                 {"xl/workbook.xml", xml + "<workbook xmlns:r=\"R\"><sheets><sheet name=\"Leg\" sheetId=\"7\" r:id=\"rId4\"/><sheet name=\"Other\" sheetId=\"1\" r:id=\"rId1\"/></sheets></workbook>"},
                 {"xl/_rels/workbook.xml.rels", xml + "<Relationships><Relationship Id=\"rId1\" Target=\"worksheets/sheet1.xml\"/><Relationship Id=\"rId4\" Target=\"/xl/worksheets/sheet2.xml\"/></Relationships>"},
                 {"xl/sharedStrings.xml", xml + "<sst><si><t>height [mm]</t></si><si><r><t>gir</t></r><r><rPr/><t>th (cm)</t></r><rPh><t>no</t></rPh></si><si><t>a &amp; b</t></si></sst>"},
                 {"xl/worksheets/sheet1.xml", xml + "<worksheet><sheetData><row r=\"1\"><c r=\"A1\"><v>99</v></c></row></sheetData></worksheet>"},
                 {"xl/worksheets/sheet2.xml", xml + "<worksheet><sheetData>" + cells + "</sheetData></worksheet>"}});
}

const std::string head_row = "<row r=\"2\"><c r=\"A2\" t=\"s\"><v>0</v></c><c r=\"B2\" t=\"s\"><v>1</v></c><c r=\"C2\" t=\"inlineStr\"><is><t>note</t></is></c></row>";

struct Read {
  Csv csv;
  Diagnostics diagnostics;
};

Read read(const std::string& bytes) {
  const auto path = std::filesystem::temp_directory_path() / ("snug_sheet_" + std::to_string(testing::UnitTest::GetInstance()->random_seed()) + testing::UnitTest::GetInstance()->current_test_info()->name());
  std::ofstream(path, std::ios::binary) << bytes;
  Read read;
  read.csv = read_csv(path, read.diagnostics, "girths.xlsx");
  std::filesystem::remove(path);
  return read;
}

std::string faults(const Read& read) {
  std::string all;
  for (const Diagnostic& one : read.diagnostics.errors()) all += one.found + " | " + one.remedy + "\n";
  return all;
}

TEST(Spreadsheet, TheFirstSheetOfAWorkbookIsATable) {
  // Rows above are empty, cells are left out, a formula has its value, a number has an exponent, a row of blanks ends the table.
  const Read sheet = read(workbook(head_row + "<row r=\"3\"><c r=\"A3\"><v>1.25E2</v></c><c r=\"B3\"><f>30+4.5</f><v>34.5</v></c><c r=\"C3\" t=\"s\"><v>2</v></c></row>"
                                          "<row r=\"5\"><c r=\"A5\"><v>250</v></c><c r=\"B5\" t=\"str\"><f>T(1)</f><v>36,25</v></c></row><row r=\"6\"><c r=\"C6\" s=\"4\"/></row>"));
  EXPECT_EQ(faults(sheet), "");
  Diagnostics diagnostics;
  EXPECT_THAT(numbers(sheet.csv, "height", "m", diagnostics), ElementsAre(0.125, 0.25));
  EXPECT_THAT(numbers(sheet.csv, "girth", "m", diagnostics), ElementsAre(testing::DoubleNear(0.345, 1e-15), testing::DoubleNear(0.3625, 1e-15)));
  EXPECT_THAT(texts(sheet.csv, "note", diagnostics), ElementsAre("a & b", ""));
  EXPECT_EQ(sheet.csv.rows[1].line, 5);
  EXPECT_FALSE(diagnostics.any());
}

TEST(Spreadsheet, FormulasWithoutAValueAndErrorsAreRefusedWithTheirCell) {
  const std::string text = faults(read(workbook(head_row + "<row r=\"3\"><c r=\"A3\"><f>A1*2</f></c><c r=\"B3\" t=\"e\"><f>1/0</f><v>#DIV/0!</v></c></row><row r=\"4\"><c r=\"AB4\" t=\"s\"><v>9</v></c></row>")));
  EXPECT_THAT(text, HasSubstr("the formula in A3 has no value"));
  EXPECT_THAT(text, HasSubstr("there is #DIV/0! in B3"));
  EXPECT_THAT(text, HasSubstr("the text of AB4 is missing"));
}

TEST(Spreadsheet, WhatStandsBesideTheTableIsSaidWithItsRow) {
  const Read sheet = read(workbook(head_row + "<row r=\"3\"><c r=\"A3\"><v>1</v></c></row><row r=\"4\"><c r=\"E4\"><v>7</v></c></row>"));
  EXPECT_EQ(faults(sheet), "5 cells where the head has 3 columns | give every column a head, and keep what is beside the table on another sheet\n");
  EXPECT_EQ(sheet.diagnostics.errors()[0].where.line, 4);
}

TEST(Spreadsheet, ATitleAboveTheTableIsPassedOver) {
  // The name of the patient in one cell over all columns, merged or not, in a workbook and in the text that is saved of it.
  const auto text = [](const std::string& cell, const std::string& what) { return "<c r=\"" + cell + "\" t=\"inlineStr\"><is><t>" + what + "</t></is></c>"; };
  const Read sheet = read(workbook("<row r=\"1\">" + text("A1", "Patient 17, left leg") + "</row><row r=\"2\">" + text("A2", "height [cm]") + text("B2", "girth [cm]") +
                                   "</row><row r=\"3\"><c r=\"A3\"><v>10</v></c><c r=\"B3\"><v>26</v></c></row>"));
  const Read saved = read("Patient 17, left leg;;\r\nheight [cm];girth [cm];\r\n10;26;\r\n");
  for (const Read* one : {&sheet, &saved}) {
    EXPECT_EQ(faults(*one), "");
    Diagnostics diagnostics;
    EXPECT_THAT(numbers(one->csv, "girth", "m", diagnostics), ElementsAre(0.26));
  }
}

TEST(Spreadsheet, UnitsInARowBelowTheHeadAreTaken) {
  // Where the head has no unit and all cells below it are units; a row of texts that are none is a row, and units of the head are not replaced.
  for (const std::string units : {"cm;cm", "[cm];[cm]", "(cm);(cm)"}) {
    const Read table = read("height;girth\n" + units + "\n10;26,5\n");
    EXPECT_EQ(faults(table), "");
    Diagnostics diagnostics;
    EXPECT_THAT(numbers(table.csv, "girth", "m", diagnostics), ElementsAre(0.265));
    EXPECT_THAT(numbers(table.csv, "height", "m", diagnostics), ElementsAre(0.1));
  }
  EXPECT_EQ(read("location;girth\nAnkle;22\n").csv.rows.size(), 1u);
  EXPECT_EQ(read("height [m];girth [mm]\ncm;cm\n").csv.rows.size(), 1u);
}

TEST(Spreadsheet, WhatIsNoSuchWorkbookIsRefused) {
  const std::string whole = workbook(head_row);
  EXPECT_THAT(faults(read(zip_of({{"content.xml", "<office/>"}, {"mimetype", "application/vnd.oasis.opendocument.spreadsheet"}}))), HasSubstr("nor an .xlsx workbook | save its sheet as .xlsx"));
  EXPECT_THAT(faults(read(whole.substr(0, whole.size() / 2))), HasSubstr("nor an .xlsx workbook"));
  EXPECT_THAT(faults(read("\xD0\xCF\x11\xE0old")), HasSubstr("an old spreadsheet program, or one with a password"));
  EXPECT_THAT(faults(read(zip_of({{"xl/workbook.xml", "<workbook><sheets/></workbook>"}}))), HasSubstr("the workbook has no sheet"));
  std::string damaged = whole;
  damaged[whole.rfind("sheetData") + 2] ^= 1;  // its checksum does not fit
  EXPECT_THAT(faults(read(damaged)), HasSubstr("cannot be read"));
  EXPECT_THAT(faults(read(workbook(""))), HasSubstr("the table has no rows"));
}

}  // namespace
}  // namespace snug::input
