#include "mesh/pattern/dxf_entities.hpp"

#include <dxflib/dl_creationadapter.h>
#include <dxflib/dl_dxf.h>

#include <cmath>
#include <istream>
#include <streambuf>

namespace snug::mesh {

namespace {

/// A text that counts the lines that have been read of it: dxflib keeps no places.
class CountedLines : public std::streambuf {
 public:
  explicit CountedLines(const std::string& text) : text_(text) {}
  int lines() const { return lines_; }

 protected:
  int_type underflow() override {
    return at_ < text_.size() ? traits_type::to_int_type(text_[at_]) : traits_type::eof();
  }
  int_type uflow() override {
    if (at_ >= text_.size()) return traits_type::eof();
    lines_ += text_[at_] == '\n';
    return traits_type::to_int_type(text_[at_++]);
  }

 private:
  const std::string& text_;
  std::size_t at_ = 0;
  int lines_ = 1;
};

class Collector : public DL_CreationAdapter {
 public:
  explicit Collector(const CountedLines& lines) : lines_(lines) {}

  void addBlock(const DL_BlockData& data) override {
    file.blocks.push_back({data.name, lines_.lines(), {}, {}, {}});
    in_block_ = true, drawing_ = false;
  }
  void endBlock() override { in_block_ = drawing_ = false; }

  void addPolyline(const DL_PolylineData& data) override {
    drawing_ = in_block_;
    if (in_block_) block().paths.push_back({layer(), {}, {}, (data.flags & 1) != 0, lines_.lines()});
  }
  void addVertex(const DL_VertexData& data) override {
    if (!drawing_) return;
    block().paths.back().points.emplace_back(data.x, data.y);
    block().paths.back().bulges.push_back(data.bulge);
  }
  void endSequence() override { drawing_ = false; }
  void addLine(const DL_LineData& data) override {
    drawing_ = false;
    if (in_block_)
      block().paths.push_back({layer(), {{data.x1, data.y1}, {data.x2, data.y2}}, {0.0, 0.0}, false, lines_.lines()});
  }
  void addPoint(const DL_PointData& data) override {
    drawing_ = false;
    if (in_block_) block().points.push_back({layer(), {data.x, data.y}, lines_.lines()});
  }
  void addText(const DL_TextData& data) override {
    drawing_ = false;
    (in_block_ ? block().texts : file.texts).push_back(data.text);
  }
  void addInsert(const DL_InsertData& data) override {
    drawing_ = false;
    if (std::abs(data.sx - 1.0) > 1e-9 || std::abs(data.sy - 1.0) > 1e-9) file.scaled_insert = lines_.lines();
  }
  void setVariableInt(const std::string& name, int value, int) override {
    if (name == "$INSUNITS") file.insert_units = value;
  }

  DxfFile file;

 private:
  DxfBlock& block() { return file.blocks.back(); }
  std::string layer() { return getAttributes().getLayer(); }

  const CountedLines& lines_;
  bool in_block_ = false, drawing_ = false;
};

}  // namespace

DxfFile read_dxf(const std::string& text, const std::string& shown_as) {
  CountedLines lines(text);
  std::istream stream(&lines);
  Collector collector(lines);
  DL_Dxf reader;
  const std::string remedy = "take a DXF text file as pattern programs write for AAMA or ASTM";
  if (text.find("SECTION") == std::string::npos)
    throw input::InputError({.file = shown_as}, "no section of a DXF file", remedy);
  if (!reader.in(stream, &collector)) throw input::InputError({.file = shown_as}, "no DXF text", remedy);
  std::erase_if(collector.file.blocks,
                [](const DxfBlock& block) { return block.name.empty() || block.name[0] == '*'; });
  return std::move(collector.file);
}

}  // namespace snug::mesh
