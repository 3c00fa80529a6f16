#include "postproc/report/template.hpp"

#include <kainjow/mustache.hpp>

#include <stdexcept>

namespace snug::postproc::report {

namespace {

namespace mustache = kainjow::mustache;

mustache::data data_of(const nlohmann::ordered_json& json) {
  if (json.is_string()) {
    const auto& text = json.get_ref<const std::string&>();
    return text.empty() ? mustache::data(false) : mustache::data(text);
  }
  if (json.is_boolean()) return mustache::data(json.get<bool>());
  if (json.is_null()) return mustache::data(false);
  if (json.is_array()) {
    mustache::data list(mustache::data::type::list);
    for (const auto& entry : json) list.push_back(data_of(entry));
    return list;
  }
  if (json.is_object()) {
    mustache::data object(mustache::data::type::object);
    for (const auto& [name, value] : json.items()) object.set(name, data_of(value));
    return object;
  }
  return mustache::data(json.dump());
}

}  // namespace

std::string fill(std::string_view text, const nlohmann::ordered_json& values,
                 const std::map<std::string, std::string_view>& parts) {
  mustache::mustache page{std::string(text)};
  if (!page.is_valid()) throw std::logic_error("template: " + page.error_message());
  mustache::data data = data_of(values);
  for (const auto& [name, part] : parts)
    data.set(name, mustache::data(mustache::partial([text = std::string(part)] { return text; })));
  return page.render(data);
}

}  // namespace snug::postproc::report
