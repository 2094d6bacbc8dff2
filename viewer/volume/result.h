#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace volumen {

/// One sentence that says what is wrong, names the file or field, and what to do about it.
struct Error {
  std::string message;
};

/// A value, or the sentence that says why there is none. For what users and files cause;
/// what only a programmer can cause is an assertion. (C++20 has no std::expected.)
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : content_(std::in_place_index<0>, std::move(value)) {}
  Result(Error error) : content_(std::in_place_index<1>, std::move(error)) {}

  bool ok() const { return content_.index() == 0; }
  explicit operator bool() const { return ok(); }

  /// The value. Only where ok().
  const T& operator*() const& { return std::get<0>(content_); }
  T& operator*() & { return std::get<0>(content_); }
  T&& operator*() && { return std::get<0>(std::move(content_)); }
  const T* operator->() const { return &std::get<0>(content_); }
  T* operator->() { return &std::get<0>(content_); }

  /// The sentence. Only where !ok().
  const std::string& message() const { return std::get<1>(content_).message; }
  Error error() const { return std::get<1>(content_); }

 private:
  std::variant<T, Error> content_;
};

/// Success, or the sentence that says why not.
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
