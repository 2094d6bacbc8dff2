#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/dicom/scan.h"

namespace volumen::dicom {

/// The elements of a scanned data set by tag, their values as text and numbers. Absent and malformed values
/// are told apart from present ones; nothing has a default.
class DataSet {
 public:
  /// A range of elements that belong together: the data set itself, or one item of a sequence.
  struct Scope {
    std::uint32_t begin = 0, end = 0;
  };

  /// `bytes` must outlive it and hold all values of `elements`.
  DataSet(Bytes bytes, const std::vector<Element>& elements)
      : bytes_(bytes), elements_(elements), characters_(text(specificCharacterSet, root())) {}

  Scope root() const { return {0, std::uint32_t(elements_.size())}; }
  const Element* find(std::uint32_t tag, Scope scope) const;
  const Element& element(std::uint32_t n) const { return elements_[n]; }
  /// All that an element holds, items and what is in them; an empty scope where there is none.
  Scope contents(std::uint32_t tag, Scope scope) const;
  /// The items of a sequence; empty where there is none.
  std::vector<Scope> items(std::uint32_t tag, Scope scope) const;

  /// Raw text without padding; empty where it is absent or longer than 1 MiB.
  std::string text(std::uint32_t tag, Scope scope) const;
  /// Text in UTF-8, by the character set of the item, else of the data set.
  std::string utf8(std::uint32_t tag, Scope scope) const;
  /// A defined term: that of `terms` which the text is in some spelling, with a remark where that is not the
  /// standard's; the text itself where it is none of them. `name`: of the attribute.
  std::string term(std::uint32_t tag, Scope scope, const char* name,
                   std::initializer_list<const char*> terms) const;
  /// The bytes of a value as they are, of whatever kind; empty where it is absent or longer than 1 MiB.
  std::string raw(std::uint32_t tag, Scope scope) const;
  /// The values of a text between backslashes, each without padding.
  std::vector<std::string> values(std::uint32_t tag, Scope scope) const;
  /// The numbers of a DS or IS, with a decimal comma as with a point; nothing where it is absent, empty or
  /// longer than 64 MiB, or one of them is no finite number.
  std::optional<std::vector<double>> numbers(std::uint32_t tag, Scope scope) const;
  std::optional<double> number(std::uint32_t tag, Scope scope) const;
  /// The first 16-bit word of a US, SS or OW.
  std::optional<std::uint16_t> word(std::uint32_t tag, Scope scope) const;
  /// A UL, and an FD.
  std::optional<std::uint32_t> dword(std::uint32_t tag, Scope scope) const;
  std::optional<double> real(std::uint32_t tag, Scope scope) const;
  /// All numbers of an FD, of an FL, of an SL and of a UL; none where it is of another kind.
  std::vector<double> reals(std::uint32_t tag, Scope scope) const;
  std::vector<float> floats(std::uint32_t tag, Scope scope) const;
  std::vector<std::int32_t> longs(std::uint32_t tag, Scope scope) const;
  std::vector<std::uint32_t> dwords(std::uint32_t tag, Scope scope) const;
  /// All 16-bit words of a value, however long.
  std::vector<std::uint16_t> words(std::uint32_t tag, Scope scope) const;
  /// All bytes of a value, however long, those of big endian 16-bit words (OW) in the order of little endian.
  std::vector<std::uint8_t> bytes(std::uint32_t tag, Scope scope) const;
  /// An element of the block that `creator` has reserved in a private group (PS3.5 7.8.1); 0: it has none.
  std::uint32_t privateTag(std::uint32_t group, std::string_view creator, std::uint32_t element,
                           Scope scope) const;
  /// An element that is there and not empty.
  bool has(std::uint32_t tag, Scope scope) const;

  /// What was read otherwise than it is written, so far: sentences without the file's name, each once.
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

/// A remark, "its ...", as a sentence of its own: "Its ... ."
std::string sentenceOf(std::string remark);

/// A finite number that takes up all of `text` (PS3.5 6.2, DS and IS), else nothing.
std::optional<double> parseNumber(std::string_view text);

/// A DA or TM as yyyymmdd or hhmmss.ffffff, which older files write as yyyy.mm.dd and hh:mm:ss (PS3.5 6.2)
/// and careless ones as yyyy-mm-dd; other text as it is.
std::string dateOrTime(std::string text);

/// `text` in UTF-8, by SpecificCharacterSet (0008,0005), code extensions included. What cannot be converted
/// becomes U+FFFD.
std::string toUtf8(const std::string& text, const std::string& specificCharacterSet);

/// What is unusual in how the character set of `text` is declared: a sentence without a file's name, for
/// toUtf8() reads what is meant; empty where all is as the standard has it, or text is plain.
std::string characterRemark(const std::string& text, const std::string& specificCharacterSet);

/// Loads character sets (`all`, or ISO 8859-1 alone), and keeps them, for a process that will not be able to
/// open files.
void loadCharacterSets(bool all);

}  // namespace volumen::dicom
