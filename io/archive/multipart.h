#pragma once

#include <string>
#include <string_view>

#include "viewer/volume/result.h"

namespace volumen {

/// Where the parts of a message go, one after the other.
class PartSink {
 public:
  virtual ~PartSink() = default;
  virtual Status beginPart() = 0;
  virtual Status partData(std::string_view bytes) = 0;
  virtual Status endPart() = 0;
};

/// Reads multipart/related (RFC 2046 5.1, RFC 2387) piece by piece, as archives write it: boundary quoted or
/// bare, lines with or without a carriage return, parts without headers. It holds little more than one piece.
class MultipartReader {
 public:
  /// The Error: `contentType` is no multipart type, or names no boundary.
  static Result<MultipartReader> of(std::string_view contentType, PartSink& sink);

  /// Takes the next bytes. The Error: the sink's, or what is wrong with the message, if it isBroken(): "a
  /// broken boundary".
  Status feed(std::string_view bytes);
  bool isBroken() const { return isBroken_; }

  /// Returns whether the last boundary was read. Without it, the message is cut off.
  bool isComplete() const { return state_ == State::over; }

 private:
  enum class State { preamble, afterBoundary, headers, bodyBegin, body, over };

  MultipartReader(std::string_view boundary, PartSink& sink)
      : boundary_("--" + std::string(boundary)), sink_(&sink) {}
  bool takePreamble();
  bool takeAfterBoundary();
  bool takeHeaders();
  bool takeBodyBegin();
  bool takeBody();
  bool give(std::size_t count);
  bool hasBoundaryAt(std::size_t at, bool& isCertain) const;
  bool wants(const Status& status);
  bool breaks(const char* what);

  std::string boundary_;
  PartSink* sink_;
  State state_ = State::preamble;
  std::string pending_;        // not yet taken
  std::size_t bytesLeft_ = 0;  // of this part, by its Content-Length
  Status problem_;
  bool isBroken_ = false;
};

/// Returns a parameter of a Content-Type, without its quotes; empty if there is none.
std::string parameterOf(std::string_view contentType, std::string_view name);

}  // namespace volumen
