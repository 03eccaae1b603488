#include "studio/api.h"

#include "core/task.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <exception>
#include <optional>
#include <utility>

namespace daumier::studio {
namespace {

std::vector<std::string_view> PartsOf(std::string_view path) {
  std::vector<std::string_view> parts;
  while (!path.empty()) {
    const size_t end = std::min(path.find('/', 1), path.size());
    parts.push_back(path.substr(1, end - 1));
    path.remove_prefix(end);
  }
  return parts;
}

bool IsVariable(std::string_view part) {
  return part.starts_with('{');
}

/// {name} takes one part of a path, {name...}, the last one, all that is left.
std::string_view NameOfVariable(std::string_view part) {
  part = part.substr(1, part.size() - 2);
  return part.ends_with("...") ? part.substr(0, part.size() - 3) : part;
}

/// The variables of a path that has the form of a route's; nothing if it has another form.
std::optional<std::map<std::string, std::string, std::less<>>> Match(std::string_view route, std::string_view path) {
  const std::vector<std::string_view> expected = PartsOf(route), found = PartsOf(path);
  const bool takes_rest = !expected.empty() && expected.back().ends_with("...}");
  if (takes_rest ? found.size() < expected.size() : found.size() != expected.size()) return std::nullopt;
  std::map<std::string, std::string, std::less<>> variables;
  for (size_t i = 0; i < expected.size(); ++i) {
    if (takes_rest && i + 1 == expected.size())
      variables.emplace(NameOfVariable(expected[i]), std::string(found[i].data(), path.data() + path.size()));
    else if (IsVariable(expected[i]))
      variables.emplace(NameOfVariable(expected[i]), found[i]);
    else if (expected[i] != found[i])
      return std::nullopt;
  }
  return variables;
}

ApiReply ErrorReply(int status, const std::string& sentence) {
  ApiReply reply = JsonReply({{"error", sentence}});
  reply.status = status;
  return reply;
}

ApiReply CallRoute(const Route& route, const ApiRequest& request) {
  try {
    return route.call(request);
  } catch (const NotFound& error) {
    return ErrorReply(404, error.what());
  } catch (const Cancelled& error) {
    return ErrorReply(409, error.what());
  } catch (const Error& error) {
    return ErrorReply(400, error.what());
  } catch (const std::exception& error) {
    return ErrorReply(500, fmt::format("the program failed: {}", error.what()));
  }
}

}  // namespace

ApiReply JsonReply(const Json& json) {
  return {.body = json.dump(-1, ' ', false, Json::error_handler_t::replace)};
}

ApiReply BinaryReply(std::string bytes) {
  return {.type = "application/octet-stream", .body = std::move(bytes)};
}

Json BodyOf(const ApiRequest& request) {
  std::optional<Json> json = TryParseJson(request.body);
  if (!json || !json->is_object()) throw UsageError("the body is no JSON object");
  return *std::move(json);
}

double NumberIn(const ApiRequest& request, std::string_view name, double otherwise) {
  const auto found = request.query.find(name);
  if (found == request.query.end()) return otherwise;
  const std::string& text = found->second;
  double number = 0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (failure != std::errc() || end != text.data() + text.size() || !std::isfinite(number))
    throw UsageError(fmt::format("'{}' is {}, expected a number", name, text.substr(0, 40)));
  return number;
}

int NumberInPath(const ApiRequest& request, std::string_view name) {
  const std::string& text = request.path.find(name)->second;
  int number = 0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (failure != std::errc() || end != text.data() + text.size())
    throw NotFound(fmt::format("'{}' is {}, expected a whole number", name, text.substr(0, 40)));
  return number;
}

ApiReply Call(const std::vector<Route>& routes, std::string_view method, std::string_view path, ApiRequest request) {
  bool is_path = false;
  for (const Route& route : routes) {
    auto variables = Match(route.path, path);
    if (!variables) continue;
    is_path = true;
    if (route.method != method) continue;
    request.path = *std::move(variables);
    return CallRoute(route, request);
  }
  if (is_path) return ErrorReply(405, fmt::format("{} is no method of {}", method, path));
  return ErrorReply(404, fmt::format("there is no {}", path));
}

Json OpenApiOf(const std::vector<Route>& routes) {
  Json paths = Json::object();
  for (const Route& route : routes) {
    std::string path;
    for (const std::string_view part : PartsOf(route.path))
      path += IsVariable(part) ? fmt::format("/{{{}}}", NameOfVariable(part)) : fmt::format("/{}", part);
    std::string method = route.method;
    std::ranges::transform(method, method.begin(), [](char c) { return char(std::tolower(c)); });
    Json& call = paths[path][method];
    call["summary"] = route.summary;
    for (const std::string_view part : PartsOf(route.path))
      if (IsVariable(part))
        call["parameters"].push_back(
            {{"name", NameOfVariable(part)}, {"in", "path"}, {"required", true}, {"schema", {{"type", "string"}}}});
    if (!route.body.is_null())
      call["requestBody"] = {{"required", true}, {"content", {{"application/json", {{"schema", route.body}}}}}};
    call["responses"]["200"] = {{"description", "done"}, {"content", {{route.reply, Json::object()}}}};
    call["responses"]["400"] = {{"description", "{\"error\": what is wrong and how to repair it}"}};
  }
  return {{"openapi", "3.1.0"},
          {"info", {{"title", "Daumier studio"}, {"version", DAUMIER_VERSION}}},
          {"components", {{"securitySchemes", {{"token", {{"type", "http"}, {"scheme", "bearer"}}}}}}},
          {"security", {{{"token", Json::array()}}}},
          {"paths", std::move(paths)}};
}

}  // namespace daumier::studio
