#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace volumen {

/// A sentence that says what is wrong, names the file or field, and says what to do about it.
struct Error {
  std::string message;
};

/// A value, or a sentence on why there is none. For causes in users and files; programming errors are
/// assertions. (C++20 has no std::expected.)
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : content_(std::in_place_index<0>, std::move(value)) {}
  Result(Error error) : content_(std::in_place_index<1>, std::move(error)) {}

  bool ok() const { return content_.index() == 0; }
  explicit operator bool() const { return ok(); }

  /// Returns the value; requires ok().
  const T& operator*() const& { return std::get<0>(content_); }
  T& operator*() & { return std::get<0>(content_); }
  T&& operator*() && { return std::get<0>(std::move(content_)); }
  const T* operator->() const { return &std::get<0>(content_); }
  T* operator->() { return &std::get<0>(content_); }

  /// Returns the sentence; requires !ok().
  const std::string& message() const { return std::get<1>(content_).message; }
  Error error() const { return std::get<1>(content_); }

 private:
  std::variant<T, Error> content_;
};

/// Success, or a sentence on why not.
class [[nodiscard]] Status {
 public:
  Status() = default;
  Status(Error error) : error_(std::move(error)) {}
  bool ok() const { return !error_; }
  explicit operator bool() const { return ok(); }
  const std::string& message() const { return error_->message; }
  Error error() const { return *error_; }

 private:
  std::optional<Error> error_;
};

}  // namespace volumen
