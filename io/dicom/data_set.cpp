#include "io/dicom/data_set.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

namespace volumen::dicom {
namespace {

constexpr std::uint64_t textLimit = 1 << 20, numbersLimit = 64 << 20;

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view padding("\0 \t\r\n", 5);
  const std::size_t begin = text.find_first_not_of(padding);
  if (begin == std::string::npos) return {};
  return text.substr(begin, text.find_last_not_of(padding) - begin + 1);
}

/// Returns letters and digits alone, in capitals.
std::string lettersOf(std::string_view text) {
  std::string letters;
  for (const char c : text)
    if (std::isalnum(std::uint8_t(c))) letters += char(std::toupper(std::uint8_t(c)));
  return letters;
}

/// Returns a number with one decimal comma, which can only have one meaning: "0,143".
std::optional<double> numberWithComma(std::string_view text) {
  std::string pointed(text);
  if (std::ranges::count(pointed, ',') != 1) return {};
  pointed[pointed.find(',')] = '.';
  return parseNumber(pointed);
}

}  // namespace

void DataSet::remark(const std::string& sentence) const {
  if (std::ranges::find(remarks_, sentence) == remarks_.end()) remarks_.push_back(sentence);
}

const Element* DataSet::find(std::uint32_t tag, Scope scope) const {
  for (std::uint32_t n = scope.begin; n < scope.end; n = elements_[n].end)
    if (elements_[n].tag == tag) return &elements_[n];
  return nullptr;
}

DataSet::Scope DataSet::contents(std::uint32_t tag, Scope scope) const {
  const Element* e = find(tag, scope);
  return e ? Scope{std::uint32_t(e - elements_.data()) + 1, e->end} : Scope{};
}

std::vector<DataSet::Scope> DataSet::items(std::uint32_t tag, Scope scope) const {
  std::vector<Scope> found;
  const Scope all = contents(tag, scope);
  for (std::uint32_t n = all.begin; n < all.end; n = elements_[n].end)
    found.push_back({n + 1, elements_[n].end});
  return found;
}

std::string DataSet::raw(std::uint32_t tag, Scope scope) const {
  const Element* e = find(tag, scope);
  if (!e || e->length > textLimit) return {};
  return std::string(reinterpret_cast<const char*>(bytes_.data()) + e->offset, e->length);
}

std::string DataSet::text(std::uint32_t tag, Scope scope) const {
  return std::string(trimmed(raw(tag, scope)));
}

std::string DataSet::utf8(std::uint32_t tag, Scope scope) const {
  const std::string found = text(tag, scope);
  const std::string own = found.empty() ? found : text(specificCharacterSet, scope);
  const std::string& characters = own.empty() ? characters_ : own;
  const std::string unusual = characterRemark(found, characters);
  if (!unusual.empty()) remark(unusual);
  std::string text = toUtf8(found, characters);
  if (text != found && text.find("\xef\xbf\xbd") != std::string::npos)
    remark(
        "some letters of its texts are damaged or none of its character set: \xef\xbf\xbd stands for them");
  return text;
}

std::string DataSet::term(std::uint32_t tag, Scope scope, const char* name,
                          std::initializer_list<const char*> terms) const {
  const std::string said = text(tag, scope), letters = lettersOf(said);
  if (letters.empty() || std::ranges::find(terms, said) != terms.end()) return said;
  const auto meant = std::ranges::find(terms, letters, lettersOf);
  if (meant == terms.end()) return said;
  remark(std::string("its ") + name + " \"" + toUtf8(said, {}) +
         "\" is no term of the standard: it was read as " + *meant);
  return *meant;
}

std::vector<std::string> DataSet::values(std::uint32_t tag, Scope scope) const {
  const std::string all = text(tag, scope);
  std::vector<std::string> found;
  for (std::size_t begin = 0; begin <= all.size() && !all.empty();) {
    const std::size_t end = std::min(all.find('\\', begin), all.size());
    found.emplace_back(trimmed(std::string_view(all).substr(begin, end - begin)));
    begin = end + 1;
  }
  return found;
}

std::optional<std::vector<double>> DataSet::numbers(std::uint32_t tag, Scope scope) const {
  const Element* e = find(tag, scope);
  if (!e || e->length > numbersLimit) return {};
  const std::string_view all =
      trimmed({reinterpret_cast<const char*>(bytes_.data()) + e->offset, std::size_t(e->length)});
  std::vector<double> found;
  for (std::size_t begin = 0; begin <= all.size();) {
    const std::size_t end = std::min(all.find('\\', begin), all.size());
    std::optional<double> number = parseNumber(all.substr(begin, end - begin));
    if (!number) {
      number = numberWithComma(all.substr(begin, end - begin));
      if (number) remark("its numbers have decimal commas: they were read as decimal points");
    }
    if (!number) return {};
    found.push_back(*number);
    begin = end + 1;
  }
  return found;
}

std::optional<double> DataSet::number(std::uint32_t tag, Scope scope) const {
  const auto all = numbers(tag, scope);
  if (!all) return {};
  return all->front();
}

template <class T>
std::vector<T> DataSet::allOf(std::uint32_t tag, Scope scope, std::uint16_t vr) const {
  const Element* e = find(tag, scope);
  const bool meant = e && (e->vr == vr || e->vr == 0 || e->vr == vrOf('U', 'N'));
  if (!meant || e->length == undefinedLength) return {};
  std::vector<T> all(e->length / sizeof(T));
  for (std::size_t n = 0; n < all.size(); ++n)
    all[n] = numberAt<T>(bytes_, e->offset + sizeof(T) * n, e->bigEndian);
  return all;
}

std::vector<double> DataSet::reals(std::uint32_t tag, Scope scope) const {
  return allOf<double>(tag, scope, vrOf('F', 'D'));
}

std::vector<float> DataSet::floats(std::uint32_t tag, Scope scope) const {
  return allOf<float>(tag, scope, vrOf('F', 'L'));
}

std::vector<std::int32_t> DataSet::longs(std::uint32_t tag, Scope scope) const {
  return allOf<std::int32_t>(tag, scope, vrOf('S', 'L'));
}

std::vector<std::uint32_t> DataSet::dwords(std::uint32_t tag, Scope scope) const {
  return allOf<std::uint32_t>(tag, scope, vrOf('U', 'L'));
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

std::uint32_t DataSet::privateTag(std::uint32_t group, std::string_view creator, std::uint32_t element,
                                  Scope scope) const {
  for (std::uint32_t n = scope.begin; n < scope.end; n = elements_[n].end) {
    const std::uint32_t tag = elements_[n].tag, block = tag & 0xffff;
    if (tag >> 16 == group && block >= 0x10 && block <= 0xff && text(tag, scope) == creator)
      return group << 16 | block << 8 | element;
  }
  return 0;
}

bool DataSet::has(std::uint32_t tag, Scope scope) const {
  const Element* e = find(tag, scope);
  return e && e->length > 0;
}

std::string sentenceOf(std::string remark) {
  if (!remark.empty()) remark[0] = char(std::toupper(std::uint8_t(remark[0])));
  return remark + '.';
}

std::optional<double> parseNumber(std::string_view text) {
  text = trimmed(text);
  const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
  double value = 0;
  const auto [end, error] = std::from_chars(begin, text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return {};
  return value;
}

std::string dateOrTime(std::string text) {
  std::string form = text;
  std::ranges::replace_if(
      form, [](char c) { return c >= '0' && c <= '9'; }, '9');
  if (form == "9999.99.99" || form == "9999-99-99") text.erase(7, 1).erase(4, 1);
  if (form.starts_with("99:99:99")) text.erase(5, 1).erase(2, 1);
  return text;
}

}  // namespace volumen::dicom
