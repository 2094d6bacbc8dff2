#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "viewer/volume/result.h"

namespace volumen::worker {

/// The last enumerator of an enumeration that is sent. Each such enumeration states it beside its fields().
template <class Enum>
inline constexpr Enum lastOf = Enum{};

/// Sends plain values between two processes of one program. For each struct, one function `fields(Wire&, T&)`
/// names its members and serves both directions. Input is never trusted: counts are believed only as far as
/// their bytes have arrived. Enumerators and flags are checked, and single floating-point numbers must be
/// finite. After the first fault ok() is false, and everything read is zero or empty.
class Wire {
 public:
  virtual ~Wire() = default;
  Wire(const Wire&) = delete;
  Wire& operator=(const Wire&) = delete;

  bool reading() const { return reading_; }
  bool ok() const { return ok_; }
  void fail() { ok_ = false; }

  /// Reads or writes exactly `count` bytes at `data`.
  void bytes(void* data, std::size_t count);

  /// Returns whether `count` bytes may be reserved, and takes them from the allowance.
  bool reserves(std::uint64_t count) {
    if (count > reservable_) return false;
    reservable_ -= count;
    return true;
  }

  template <class... T>
  void operator()(T&... values) {
    (value(values), ...);
  }
  /// Writes values that are const.
  template <class... T>
  void write(const T&... values) {
    (value(const_cast<T&>(values)), ...);
  }

 protected:
  explicit Wire(bool reading) : reading_(reading) {}
  /// Opens the next piece to read from or write to, which must not be empty. Returns false if there is none.
  virtual bool nextPiece() = 0;
  std::uint8_t *at_ = nullptr, *end_ = nullptr;
  /// Memory that may be reserved for elements before they have come: else it grows by halves, and is copied.
  std::uint64_t reservable_ = 0;

 private:
  template <class T>
  void value(T& v) {
    if constexpr (std::is_same_v<T, bool>) {
      std::uint8_t byte = v;
      bytes(&byte, 1);
      if (byte > 1) fail();
      v = byte == 1;
    } else if constexpr (std::is_enum_v<T>) {
      static_assert(lastOf<T> != T{}, "say lastOf of this enumeration");
      auto number = std::int32_t(v);
      bytes(&number, sizeof number);
      if (number < 0 || number > std::int32_t(lastOf<T>)) fail(), number = 0;
      v = T(number);
    } else if constexpr (std::is_floating_point_v<T>) {
      bytes(&v, sizeof v);
      if (reading_ && !std::isfinite(v)) fail(), v = 0;
    } else if constexpr (std::is_arithmetic_v<T>) {
      bytes(&v, sizeof v);
    } else {
      fields(*this, v);
    }
  }

  const bool reading_;
  bool ok_ = true;
};

/// Writes to a growing buffer.
class MemoryWriter : public Wire {
 public:
  MemoryWriter() : Wire(false) {}
  std::vector<std::uint8_t> take() &&;

 private:
  bool nextPiece() override;
  std::vector<std::uint8_t> bytes_;
};

/// Reads from memory that must outlive it.
class MemoryReader : public Wire {
 public:
  explicit MemoryReader(std::span<const std::uint8_t> bytes);

 private:
  bool nextPiece() override { return false; }
};

template <class T>
inline constexpr bool isBulk = std::is_arithmetic_v<T> && !std::is_same_v<T, bool>;

/// Sends contiguous elements. When reading, memory grows as the data arrive: by `step` elements or by
/// doubling at most.
template <class Container>
void bulk(Wire& w, Container& v) {
  constexpr std::size_t size = sizeof(typename Container::value_type), step = (std::size_t(4) << 20) / size;
  std::uint64_t count = v.size();
  w(count);
  if (!w.reading()) return w.bytes(v.data(), v.size() * size);
  v.clear();
  if (count <= std::numeric_limits<std::uint64_t>::max() / size && w.reserves(count * size)) v.reserve(count);
  while (w.ok() && v.size() < count) {
    const std::size_t have = v.size(), more = std::min<std::uint64_t>(count - have, std::max(step, have));
    v.resize(have + more);
    w.bytes(v.data() + have, more * size);
  }
  if (!w.ok()) v.clear();
}

inline void fields(Wire& w, std::string& text) { bulk(w, text); }

template <class T>
void fields(Wire& w, std::vector<T>& v) {
  if constexpr (isBulk<T>) return bulk(w, v);
  std::uint64_t count = v.size();
  w(count);
  if (!w.reading()) {
    for (T& element : v) w(element);
    return;
  }
  v.clear();
  while (w.ok() && v.size() < count) w(v.emplace_back());
  if (!w.ok()) v.clear();
}

template <class T>
void fields(Wire& w, std::optional<T>& v) {
  bool there = v.has_value();
  w(there);
  if (w.reading()) v = there ? std::optional<T>(T{}) : std::nullopt;
  if (v) w(*v);
}

template <class A, class B>
void fields(Wire& w, std::pair<A, B>& v) {
  w(v.first, v.second);
}

template <class T, std::size_t n>
void fields(Wire& w, std::array<T, n>& v) {
  for (T& element : v) w(element);
}

template <class T, std::size_t n>
void fields(Wire& w, T (&v)[n]) {
  for (T& element : v) w(element);
}

template <class... T>
void fields(Wire& w, std::tuple<T...>& v) {
  std::apply([&](T&... elements) { w(elements...); }, v);
}

template <class... T>
void fields(Wire& w, std::variant<T...>& v) {
  auto index = std::uint8_t(v.index());
  w(index);
  if (index >= sizeof...(T)) return w.fail();
  if (w.reading()) {
    std::uint8_t n = 0;
    ((n++ == index ? void(v.template emplace<T>()) : void()), ...);
  }
  std::visit([&](auto& held) { w(held); }, v);
}

template <int n, class T, glm::qualifier q>
void fields(Wire& w, glm::vec<n, T, q>& v) {
  for (int a = 0; a < n; ++a) w(v[a]);
}

inline void fields(Wire& w, glm::dmat3& m) { w(m[0], m[1], m[2]); }

}  // namespace volumen::worker
