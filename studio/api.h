#pragma once
#include "core/error.h"
#include "core/json.h"

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

/// Calls of the studio's API without sockets: what the server passes on, and what a test calls.
namespace daumier::studio {

struct ApiRequest {
  std::map<std::string, std::string, std::less<>> path;   ///< {"id": "s-0001"} of /api/sessions/{id}.
  std::map<std::string, std::string, std::less<>> query;  ///< Decoded.
  std::string_view body = {};
};

struct ApiReply {
  int status = 200;
  std::string type = "application/json";
  std::string body;
};

ApiReply JsonReply(const Json& json);
ApiReply BinaryReply(std::string bytes);

/// What a call names does not exist: status 404.
class NotFound : public Error {
 public:
  using Error::Error;
};

/// The body as an object. @throws UsageError saying what is wrong with it.
Json BodyOf(const ApiRequest& request);
/// A number of the query, or the default. @throws UsageError if it is none or not finite.
double NumberIn(const ApiRequest& request, std::string_view name, double otherwise);

/// A whole number in the path. @throws NotFound if it is none.
int NumberInPath(const ApiRequest& request, std::string_view name);

/// One call of the API.
struct Route {
  std::string method;  ///< "GET"
  std::string path;    ///< "/api/sessions/{id}"
  std::string summary;
  std::function<ApiReply(const ApiRequest&)> call;
  Json body = {};                          ///< JSON schema of the request; null: it has none.
  std::string reply = "application/json";  ///< Type of a successful reply.
};

/// The reply to a request that names no route's path: 404, or 405 if the path is one of another method. Errors become replies
/// {"error": sentence}: 404 of NotFound, 409 of Cancelled, 400 of Error and its kinds, 500 of anything else.
ApiReply Call(const std::vector<Route>& routes, std::string_view method, std::string_view path, ApiRequest request);

/// The OpenAPI 3.1 description of the routes.
Json OpenApiOf(const std::vector<Route>& routes);

}  // namespace daumier::studio
