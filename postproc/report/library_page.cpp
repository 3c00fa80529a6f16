// The page to browse the library.
#include "postproc/report/assets.hpp"
#include "postproc/report/page.hpp"
#include "postproc/report/template.hpp"

namespace snug::postproc::report {

std::string library_page(const std::string& title, const std::string& date, const nlohmann::ordered_json& entities) {
  // In a script element nothing but "<" could end it.
  std::string text = entities.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace), data;
  for (const char c : text) data += c == '<' ? std::string("\\u003c") : std::string(1, c);
  return fill(library_template(), {{"title", title}, {"date", date}, {"data", data}, {"style", style()}, {"script", library_script()}});
}

}  // namespace snug::postproc::report
