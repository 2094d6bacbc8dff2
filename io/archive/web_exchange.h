#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "io/archive/archives.h"
#include "viewer/volume/cancel.h"

class QHttpMultiPart;

namespace volumen {

/// A request to an archive's web services.
struct WebRequest {
  std::string target;  ///< below the archive's URL, percent-encoded: "/studies?limit=1"
  std::string accept;  ///< media type of the answer
  /// Makes the body of a POST, whose type is `contentType` and its boundary; none: GET.
  std::function<std::unique_ptr<QHttpMultiPart>()> body;
  bool isCompressible = true;  ///< the answer may be sent in gzip
};

struct WebAnswer {
  int status = 0;           ///< of HTTP; redirects, 401 and 403 never come
  std::string contentType;  ///< as sent
  bool isPart = false;      ///< the archive says that it has more (Warning: 299)
  bool isMeasured = false;  ///< its end is told by more than that of the connection
};

/// Requests to an archive by HTTP (PS3.18). Each waits 5 s for the connection, and 30 s for each progress.
/// Passwords and tokens come from the archive's commands; a token that has expired is asked for anew. A
/// redirect to another host is refused. Requests that a busy archive refuses are repeated. Errors are
/// sentences that name the archive and what to do. Used by one thread at a time. After a POST it waits 5 min.
class WebExchange {
 public:
  WebExchange(const Archive& archive, const CancelToken& cancel);
  ~WebExchange();

  /// Gets the body of an answer whose status is 200 to 299, or 409, piece by piece. An Error ends the
  /// request.
  using OnBody = std::function<Status(const WebAnswer&, std::string_view)>;

  /// Returns the answer. The Error: the connection's, that of `onBody`, or the archive refuses our
  /// credentials.
  Result<WebAnswer> send(const WebRequest& request, const OnBody& onBody);

  /// Returns "The archive "X" (URL) PREDICATE."
  Error says(const std::string& predicate) const;

 private:
  struct Private;
  std::unique_ptr<Private> p_;
};

}  // namespace volumen
