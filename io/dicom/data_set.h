#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/dicom/scan.h"

namespace volumen::dicom {

/// Gives access to the elements of a scanned data set by tag, with values as text and numbers. Absent and
/// malformed values differ from present ones; nothing has a default.
class DataSet {
 public:
  /// A range of elements that belong together: the data set itself or one item of a sequence.
  struct Scope {
    std::uint32_t begin = 0, end = 0;
  };

  /// `bytes` must outlive the object and hold all values of `elements`.
  DataSet(Bytes bytes, const std::vector<Element>& elements)
      : bytes_(bytes), elements_(elements), characters_(text(specificCharacterSet, root())) {}

  Scope root() const { return {0, std::uint32_t(elements_.size())}; }
  const Element* find(std::uint32_t tag, Scope scope) const;
  const Element& element(std::uint32_t n) const { return elements_[n]; }
  /// Returns the items of an element with everything in them; an empty scope if it is absent.
  Scope contents(std::uint32_t tag, Scope scope) const;
  /// Returns the items of a sequence; empty if it is absent.
  std::vector<Scope> items(std::uint32_t tag, Scope scope) const;

  /// Returns raw text without padding; empty if absent or longer than 1 MiB.
  std::string text(std::uint32_t tag, Scope scope) const;
  /// Returns text in UTF-8, by the character set of the item, else of the data set.
  std::string utf8(std::uint32_t tag, Scope scope) const;
  /// Returns a defined term: the one of `terms` that the text spells in some way, else the text itself. A
  /// spelling that is not the standard's is remarked, with the attribute's `name`.
  std::string term(std::uint32_t tag, Scope scope, const char* name,
                   std::initializer_list<const char*> terms) const;
  /// Returns the bytes of a value of any kind, unchanged; empty if absent or longer than 1 MiB.
  std::string raw(std::uint32_t tag, Scope scope) const;
  /// Returns the values of a text between backslashes, each without padding.
  std::vector<std::string> values(std::uint32_t tag, Scope scope) const;
  /// Returns the numbers of a DS or IS; decimal commas count as points. Returns nothing if the value is
  /// absent, empty or longer than 64 MiB, or if one of them is no finite number.
  std::optional<std::vector<double>> numbers(std::uint32_t tag, Scope scope) const;
  std::optional<double> number(std::uint32_t tag, Scope scope) const;
  /// Returns the first 16-bit word of a US, SS or OW.
  std::optional<std::uint16_t> word(std::uint32_t tag, Scope scope) const;
  /// Returns the first number of a UL (dword) or FD (real).
  std::optional<std::uint32_t> dword(std::uint32_t tag, Scope scope) const;
  std::optional<double> real(std::uint32_t tag, Scope scope) const;
  /// Return all numbers of an FD, FL, SL or UL; empty if the value has another VR.
  std::vector<double> reals(std::uint32_t tag, Scope scope) const;
  std::vector<float> floats(std::uint32_t tag, Scope scope) const;
  std::vector<std::int32_t> longs(std::uint32_t tag, Scope scope) const;
  std::vector<std::uint32_t> dwords(std::uint32_t tag, Scope scope) const;
  /// Returns all 16-bit words of a value of any length.
  std::vector<std::uint16_t> words(std::uint32_t tag, Scope scope) const;
  /// Returns all bytes of a value of any length. Big endian 16-bit words (OW) are turned into little endian
  /// order.
  std::vector<std::uint8_t> bytes(std::uint32_t tag, Scope scope) const;
  /// Returns the tag of `element` in the block that `creator` reserved in a private group (PS3.5 7.8.1), or
  /// 0.
  std::uint32_t privateTag(std::uint32_t group, std::string_view creator, std::uint32_t element,
                           Scope scope) const;
  /// Returns whether an element is present and not empty.
  bool has(std::uint32_t tag, Scope scope) const;

  /// Returns the remarks so far on values read differently from how they are written: sentences without the
  /// file's name, each once.
  const std::vector<std::string>& remarks() const { return remarks_; }
  void remark(const std::string& sentence) const;

 private:
  static constexpr std::uint32_t specificCharacterSet = 0x00080005;

  template <class T>
  std::optional<T> numberOf(std::uint32_t tag, Scope scope) const;
  template <class T>
  std::vector<T> allOf(std::uint32_t tag, Scope scope, std::uint16_t vr) const;

  Bytes bytes_;
  const std::vector<Element>& elements_;
  std::string characters_;  // SpecificCharacterSet of the data set
  mutable std::vector<std::string> remarks_;
};

/// Returns a remark, "its ...", as a complete sentence: "Its ... ."
std::string sentenceOf(std::string remark);

/// Returns the finite number that fills all of `text` (PS3.5 6.2, DS and IS), else nothing.
std::optional<double> parseNumber(std::string_view text);

/// Returns a DA or TM as yyyymmdd or hhmmss.ffffff. Older files write yyyy.mm.dd and hh:mm:ss (PS3.5 6.2),
/// and careless ones yyyy-mm-dd. Other text is returned unchanged.
std::string dateOrTime(std::string text);

/// Returns `text` in UTF-8, decoded by SpecificCharacterSet (0008,0005) with code extensions. Bytes that
/// cannot be converted become U+FFFD.
std::string toUtf8(const std::string& text, const std::string& specificCharacterSet);

/// Returns UTF-8 text in a character set, as toUtf8() reads it. Nothing if the set does not hold all of it,
/// or for other than plain ASCII text in sets with code extensions.
std::optional<std::string> fromUtf8(const std::string& text, const std::string& specificCharacterSet);

/// Returns a sentence, without a file's name, about an unusual declaration of the character set of `text`,
/// which toUtf8() reads as it is meant. Empty if the declaration follows the standard or the text is plain
/// ASCII.
std::string characterRemark(const std::string& text, const std::string& specificCharacterSet);

/// Loads character sets (`all`, or ASCII, ISO 8859-1 and UTF-8) and keeps them for a process that cannot open
/// files later.
void loadCharacterSets(bool all);

}  // namespace volumen::dicom
