#include "io/dicom/data_set.h"

#include <charconv>
#include <cmath>

namespace volumen::dicom {
namespace {

constexpr std::uint64_t textLimit = 1 << 20;

std::string trimmed(const std::string& text) {
  constexpr std::string_view padding("\0 \t\r\n", 5);
  const std::size_t begin = text.find_first_not_of(padding);
  if (begin == std::string::npos) return {};
  return text.substr(begin, text.find_last_not_of(padding) - begin + 1);
}

}  // namespace

const Element* DataSet::find(std::uint32_t tag, Scope scope) const {
  for (std::uint32_t n = scope.begin; n < scope.end; n = elements_[n].end)
    if (elements_[n].tag == tag) return &elements_[n];
  return nullptr;
}

std::vector<DataSet::Scope> DataSet::items(std::uint32_t tag, Scope scope) const {
  std::vector<Scope> found;
  const Element* sequence = find(tag, scope);
  if (!sequence) return found;
  const std::uint32_t first = std::uint32_t(sequence - elements_.data()) + 1;
  for (std::uint32_t n = first; n < sequence->end; n = elements_[n].end)
    found.push_back({n + 1, elements_[n].end});
  return found;
}

std::string DataSet::raw(std::uint32_t tag, Scope scope) const {
  const Element* e = find(tag, scope);
  if (!e || e->length > textLimit) return {};
  return std::string(reinterpret_cast<const char*>(bytes_.data()) + e->offset, e->length);
}

std::string DataSet::text(std::uint32_t tag, Scope scope) const { return trimmed(raw(tag, scope)); }

std::vector<std::string> DataSet::values(std::uint32_t tag, Scope scope) const {
  const std::string all = text(tag, scope);
  std::vector<std::string> found;
  for (std::size_t begin = 0; begin <= all.size() && !all.empty();) {
    const std::size_t end = std::min(all.find('\\', begin), all.size());
    found.push_back(trimmed(all.substr(begin, end - begin)));
    begin = end + 1;
  }
  return found;
}

std::optional<std::vector<double>> DataSet::numbers(std::uint32_t tag, Scope scope) const {
  std::vector<double> found;
  for (const std::string& value : values(tag, scope)) {
    const std::optional<double> number = parseNumber(value);
    if (!number) return {};
    found.push_back(*number);
  }
  if (found.empty()) return {};
  return found;
}

std::optional<double> DataSet::number(std::uint32_t tag, Scope scope) const {
  const auto all = numbers(tag, scope);
  if (!all) return {};
  return all->front();
}

template <class T>
std::optional<T> DataSet::numberOf(std::uint32_t tag, Scope scope) const {
  const Element* e = find(tag, scope);
  if (!e || e->length < sizeof(T) || e->length == undefinedLength) return {};
  return numberAt<T>(bytes_, e->offset, e->bigEndian);
}

std::optional<std::uint16_t> DataSet::word(std::uint32_t tag, Scope scope) const {
  return numberOf<std::uint16_t>(tag, scope);
}

std::optional<std::uint32_t> DataSet::dword(std::uint32_t tag, Scope scope) const {
  return numberOf<std::uint32_t>(tag, scope);
}

std::optional<double> DataSet::real(std::uint32_t tag, Scope scope) const {
  return numberOf<double>(tag, scope);
}

std::vector<std::uint16_t> DataSet::words(std::uint32_t tag, Scope scope) const {
  const Element* e = find(tag, scope);
  if (!e || e->length == undefinedLength) return {};
  std::vector<std::uint16_t> words(e->length / 2);
  for (std::size_t n = 0; n < words.size(); ++n)
    words[n] = numberAt<std::uint16_t>(bytes_, e->offset + 2 * n, e->bigEndian);
  return words;
}

std::vector<std::uint8_t> DataSet::bytes(std::uint32_t tag, Scope scope) const {
  const Element* e = find(tag, scope);
  if (!e || e->length == undefinedLength) return {};
  const auto begin = bytes_.begin() + std::ptrdiff_t(e->offset);
  std::vector<std::uint8_t> bytes(begin, begin + std::ptrdiff_t(e->length));
  if (e->bigEndian && e->vr == vrOf('O', 'W'))
    for (std::size_t n = 0; n + 1 < bytes.size(); n += 2) std::swap(bytes[n], bytes[n + 1]);
  return bytes;
}

bool DataSet::has(std::uint32_t tag, Scope scope) const {
  const Element* e = find(tag, scope);
  return e && e->length > 0;
}

std::optional<double> parseNumber(std::string text) {
  text = trimmed(text);
  const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
  double value = 0;
  const auto [end, error] = std::from_chars(begin, text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return {};
  return value;
}

}  // namespace volumen::dicom
