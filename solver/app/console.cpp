#include "solver/app/console.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>

#include "cases/input/warned_error.hpp"
#include "postproc/documents.hpp"
#include "solver/app/wrapping.hpp"

namespace snug::app {

using postproc::Json;

namespace {

Json diagnostic_json(const input::Diagnostic& diagnostic, const std::string& text) {
  Json json = {{"text", text}};
  if (!diagnostic.where.file.empty()) json["file"] = diagnostic.where.file;
  if (diagnostic.where.line > 0) json["line"] = diagnostic.where.line, json["column"] = diagnostic.where.column;
  json["found"] = diagnostic.found;
  json["remedy"] = diagnostic.remedy;
  return json;
}

std::string without_line_end(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

Json lines_json(const std::string& text) {
  Json lines = Json::array();
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

}  // namespace

std::size_t width_of(std::FILE* stream) {
  constexpr std::size_t narrowest = 40, usual = 80, widest = 100;
  if (isatty(fileno(stream)) == 0) return 0;
  winsize size{};
  const char* said = std::getenv("COLUMNS");
  const long columns = said ? std::strtol(said, nullptr, 10) : ioctl(fileno(stream), TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
  return columns <= 0 ? usual : std::clamp(static_cast<std::size_t>(columns), narrowest, widest);
}

Console::Console()
    : document_(std::make_unique<Json>(Json::object())), warnings_(std::make_unique<Json>(Json::array())), errors_(std::make_unique<Json>(Json::array())),
      out_width_(width_of(stdout)), error_width_(width_of(stderr)) {}
Console::~Console() = default;

Json& Console::document() { return *document_; }

void Console::to_standard_output(const std::string& text) {
  if (json_) {
    text_ += text;
    return;
  }
  std::fwrite(text.data(), 1, text.size(), stdout);  // nobody may be listening any more: that costs no solution, and is told at the end
  std::fflush(stdout);
}

void Console::say(const std::string& text) { to_standard_output(wrapped(text, json_ ? 0 : out_width_)); }
void Console::say_as_it_is(const std::string& text) { to_standard_output(text); }

void Console::to_standard_error(const std::string& line) const {
  const std::string lines = wrapped(without_line_end(line), error_width_) + "\n";
  std::fwrite(lines.data(), 1, lines.size(), stderr);
}

void Console::note(const std::string& text) { to_standard_error(text); }

void Console::warn(const input::Diagnostic& warning) {
  const std::string text = input::warning_text(warning);
  to_standard_error(text);
  warnings_->push_back(diagnostic_json(warning, text));
}

void Console::warn(const std::string& text) {
  to_standard_error(text);
  warnings_->push_back(Json::object({{"text", without_line_end(text)}}));
}

void Console::error(const input::InputError& error) {
  if (const auto* warned = dynamic_cast<const input::WarnedError*>(&error))
    for (const input::Diagnostic& warning : warned->warnings()) warn(warning);
  to_standard_error(error.what());
  for (const input::Diagnostic& one : error.errors()) errors_->push_back(diagnostic_json(one, input::to_string(one)));
}

void Console::error(const std::string& text) {
  to_standard_error(text);
  errors_->push_back(Json::object({{"text", without_line_end(text)}}));
}

bool Console::finish(const std::string& command, int status) {
  if (json_ && !silent_) {
    Json whole = {{"command", command}, {"exit_status", status}, {"warnings", *warnings_}, {"errors", *errors_}};
    if (document_->empty() && !text_.empty()) whole["text"] = lines_json(text_);
    whole.update(*document_);
    const std::string text = postproc::text_of(whole);
    std::fwrite(text.data(), 1, text.size(), stdout);
    silent_ = true;
  }
  return std::fflush(stdout) == 0 && !std::ferror(stdout);
}

}  // namespace snug::app
