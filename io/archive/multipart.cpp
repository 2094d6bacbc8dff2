#include "io/archive/multipart.h"

#include <algorithm>
#include <cctype>
#include <charconv>

namespace volumen {

namespace {

constexpr std::size_t mostBytesOfHeaders = 64 << 10;
constexpr std::size_t mostBytesOfBoundary = 200;  // 70 in RFC 2046
// A boundary as short as "boundary" may occur in the data: there the length of a part counts.
constexpr std::size_t shortBoundary = 16;

std::string lowered(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = char(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

bool isBlank(char c) { return c == ' ' || c == '\t'; }

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && isBlank(text.front())) text.remove_prefix(1);
  while (!text.empty() && (isBlank(text.back()) || text.back() == '\r')) text.remove_suffix(1);
  return text;
}

// Returns the number in the header Content-Length; 0 if there is none.
std::size_t lengthIn(std::string_view headers) {
  while (!headers.empty()) {
    const std::size_t end = std::min(headers.find('\n'), headers.size());
    const std::string_view line = headers.substr(0, end);
    headers.remove_prefix(std::min(end + 1, headers.size()));
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos || lowered(trimmed(line.substr(0, colon))) != "content-length")
      continue;
    const std::string_view digits = trimmed(line.substr(colon + 1));
    std::size_t length = 0;
    std::from_chars(digits.data(), digits.data() + digits.size(), length);
    return length;
  }
  return 0;
}

// Reads one parameter ("name=value" or "name="value"") from the start of `rest`, after its semicolon.
struct Parameter {
  std::string name, value;
};

Parameter nextParameter(std::string_view& rest) {
  const std::size_t equals = std::min(rest.find_first_of("=;"), rest.size());
  Parameter one{lowered(trimmed(rest.substr(0, equals))), ""};
  rest.remove_prefix(equals);
  if (rest.empty() || rest.front() == ';') return one;
  rest.remove_prefix(1);
  while (!rest.empty() && isBlank(rest.front())) rest.remove_prefix(1);
  if (!rest.empty() && rest.front() == '"') {
    rest.remove_prefix(1);
    while (!rest.empty() && rest.front() != '"') {
      if (rest.front() == '\\' && rest.size() > 1) rest.remove_prefix(1);
      one.value += rest.front();
      rest.remove_prefix(1);
    }
    if (!rest.empty()) rest.remove_prefix(1);
    return one;
  }
  const std::size_t end = std::min(rest.find(';'), rest.size());
  one.value = trimmed(rest.substr(0, end));
  rest.remove_prefix(end);
  return one;
}

}  // namespace

std::string parameterOf(std::string_view contentType, std::string_view name) {
  std::size_t semicolon = contentType.find(';');
  while (semicolon != std::string_view::npos) {
    contentType.remove_prefix(semicolon + 1);
    const Parameter one = nextParameter(contentType);
    if (one.name == name) return one.value;
    semicolon = contentType.find(';');
  }
  return {};
}

Result<MultipartReader> MultipartReader::of(std::string_view contentType, PartSink& sink) {
  if (!lowered(trimmed(contentType)).starts_with("multipart/")) return Error{"no message of several parts"};
  const std::string boundary = parameterOf(contentType, "boundary");
  if (boundary.empty() || boundary.size() > mostBytesOfBoundary)
    return Error{"a message without a boundary of its parts"};
  return MultipartReader(boundary, sink);
}

Status MultipartReader::feed(std::string_view bytes) {
  if (state_ == State::over) return {};
  pending_ += bytes;
  bool goesOn = true;
  while (goesOn && problem_) {
    switch (state_) {
      case State::preamble:
        goesOn = takePreamble();
        break;
      case State::afterBoundary:
        goesOn = takeAfterBoundary();
        break;
      case State::headers:
        goesOn = takeHeaders();
        break;
      case State::bodyBegin:
        goesOn = takeBodyBegin();
        break;
      case State::body:
        goesOn = takeBody();
        break;
      case State::over:
        goesOn = false;
        break;
    }
  }
  return problem_;
}

bool MultipartReader::breaks(const char* what) {
  isBroken_ = true;
  problem_ = Error{what};
  return false;
}

bool MultipartReader::wants(const Status& status) {
  if (!status && problem_) problem_ = status;
  return bool(problem_);
}

// Return whether more can be done with what is pending.
bool MultipartReader::takePreamble() {
  std::size_t at = pending_.find(boundary_);
  while (at != std::string::npos && at > 0 && pending_[at - 1] != '\n') at = pending_.find(boundary_, at + 1);
  if (at != std::string::npos) {
    pending_.erase(0, at + boundary_.size());
    state_ = State::afterBoundary;
    return true;
  }
  return pending_.size() > mostBytesOfHeaders && breaks("a message without its boundary");
}

bool MultipartReader::takeAfterBoundary() {
  if (pending_.starts_with("--")) {
    state_ = State::over;
    pending_.clear();
    return false;
  }
  const std::size_t end = pending_.find('\n');
  if (end == std::string::npos) return pending_.size() > mostBytesOfHeaders && breaks("a broken boundary");
  pending_.erase(0, end + 1);
  state_ = State::headers;
  return true;
}

bool MultipartReader::takeHeaders() {
  // Headers end with an empty line; a part may have none.
  std::size_t line = 0;
  for (;;) {
    const std::size_t end = pending_.find('\n', line);
    if (end == std::string::npos)
      return pending_.size() > mostBytesOfHeaders && breaks("a part whose headers do not end");
    const bool isEmpty = end == line || (end == line + 1 && pending_[line] == '\r');
    if (!isEmpty) {
      line = end + 1;
      continue;
    }
    const std::size_t length = lengthIn(std::string_view(pending_).substr(0, line));
    bytesLeft_ = boundary_.size() - 2 < shortBoundary ? length : 0;
    pending_.erase(0, end + 1);
    state_ = State::bodyBegin;
    return wants(sink_->beginPart());
  }
}

// Some archives write one line end too many; no DICOM file begins with one.
bool MultipartReader::takeBodyBegin() {
  if (pending_.size() < boundary_.size() + 4) return false;
  const bool isEmpty = pending_.starts_with(boundary_) ||
                       pending_.compare(1, boundary_.size(), boundary_) == 0 ||
                       pending_.compare(2, boundary_.size(), boundary_) == 0;
  if (pending_.starts_with(boundary_)) pending_.insert(0, "\n");
  if (!isEmpty && bytesLeft_ == 0 && pending_.starts_with("\r\n")) pending_.erase(0, 2);
  if (isEmpty) bytesLeft_ = 0;
  state_ = State::body;
  return true;
}

// Returns whether a boundary follows its line end at `at`. It is not certain before its next characters are
// there.
bool MultipartReader::hasBoundaryAt(std::size_t at, bool& isCertain) const {
  const std::size_t after = at + boundary_.size();
  isCertain = pending_.size() >= after + 2;
  if (!isCertain) return pending_.compare(at, boundary_.size(), boundary_, 0, pending_.size() - at) == 0;
  if (pending_.compare(at, boundary_.size(), boundary_) != 0) return false;
  const char next = pending_[after];
  return next == '\n' || next == '\r' || isBlank(next) || pending_.compare(after, 2, "--") == 0;
}

bool MultipartReader::give(std::size_t count) {
  if (count == 0) return true;
  if (!wants(sink_->partData(std::string_view(pending_).substr(0, count)))) return false;
  pending_.erase(0, count);
  return true;
}

bool MultipartReader::takeBody() {
  if (bytesLeft_ > 0) {
    const std::size_t count = std::min(bytesLeft_, pending_.size());
    if (!give(count)) return false;
    bytesLeft_ -= count;
    if (bytesLeft_ > 0) return false;
  }
  // An empty part has its boundary at once.
  std::size_t from = 0;
  for (;;) {
    const std::size_t line = pending_.find("\n--", from);
    if (line == std::string::npos) break;
    bool isCertain = false;
    const bool isBoundary = hasBoundaryAt(line + 1, isCertain);
    if (isBoundary) {
      // What comes before is data; a carriage return may belong to the boundary.
      if (!give(line > 0 && pending_[line - 1] == '\r' ? line - 1 : line) || !isCertain) return false;
      pending_.erase(0, pending_.find("\n--") + 1 + boundary_.size());
      state_ = State::afterBoundary;
      return wants(sink_->endPart());
    }
    from = line + 1;
  }
  // The last bytes may begin a boundary.
  constexpr std::size_t start = 4;  // "\r\n--"
  if (pending_.size() > start) give(pending_.size() - start);
  return false;
}

}  // namespace volumen
