#include <iconv.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <utility>

#include "io/dicom/data_set.h"
#include "io/worker/serve.h"

namespace volumen::dicom {
namespace {

/// A character set of PS3.3 C.12.1.1.2. `term` lacks "ISO_IR " or "ISO 2022 IR ", `escape` lacks ESC. `bytes`
/// says how its bytes become an encoding that iconv knows.
struct CharacterSet {
  const char* term;
  const char* escape;
  const char* encoding;
  enum Bytes { asTheyAre, highBits, highBitsWithPrefix } bytes = asTheyAre;
};

constexpr CharacterSet sets[] = {
    {"6", "(B", "ASCII"},
    {"100", "-A", "ISO-8859-1"},
    {"101", "-B", "ISO-8859-2"},
    {"109", "-C", "ISO-8859-3"},
    {"110", "-D", "ISO-8859-4"},
    {"144", "-L", "ISO-8859-5"},
    {"127", "-G", "ISO-8859-6"},
    {"126", "-F", "ISO-8859-7"},
    {"138", "-H", "ISO-8859-8"},
    {"148", "-M", "ISO-8859-9"},
    {"203", "-b", "ISO-8859-15"},
    {"166", "-T", "TIS-620"},
    {"13", ")I", "SHIFT_JIS"},
    {"13", "(J", "ASCII"},
    // ISO 2022 uses the seven-bit form of these (GL); EUC has the high bits set.
    {"87", "$B", "EUC-JP", CharacterSet::highBits},
    {"159", "$(D", "EUC-JP", CharacterSet::highBitsWithPrefix},
    {"149", "$)C", "EUC-KR"},
    {"58", "$)A", "GB2312"},
    {"192", nullptr, "UTF-8"},
    {"GB18030", nullptr, "GB18030"},
    {"GBK", nullptr, "GBK"},
};
constexpr const CharacterSet& ascii = sets[0];

/// Common misspellings of defined terms, reduced to capital letters and digits.
constexpr std::pair<std::string_view, const char*> otherNames[] = {
    {"UTF8", "192"},     {"ISO10646", "192"}, {"ASCII", "6"},      {"USASCII", "6"},    {"LATIN1", "100"},
    {"ISO88591", "100"}, {"ISO88592", "101"}, {"ISO88593", "109"}, {"ISO88594", "110"}, {"ISO88595", "144"},
    {"ISO88596", "127"}, {"ISO88597", "126"}, {"ISO88598", "138"}, {"ISO88599", "148"}, {"ISO885915", "203"},
    {"TIS620", "166"},   {"SHIFTJIS", "13"},  {"SJIS", "13"},      {"EUCKR", "149"},    {"GB2312", "GBK"}};

const CharacterSet* setOf(std::string_view name) {
  const auto it = std::ranges::find(sets, name, [](const CharacterSet& set) { return set.term; });
  return it == std::end(sets) ? nullptr : it;
}

std::string withoutPrefix(std::string term, std::initializer_list<std::string_view> prefixes) {
  for (const std::string_view prefix : prefixes)
    if (term.starts_with(prefix)) return term.substr(prefix.size());
  return term;
}

/// Returns the character set that a value of SpecificCharacterSet means, or null if unknown. Sets `exact` if
/// the value is the standard's term. An empty value means ASCII.
const CharacterSet* meantBy(const std::string& value, bool& exact) {
  exact = true;
  if (value.empty()) return &ascii;
  if (const CharacterSet* set = setOf(withoutPrefix(value, {"ISO_IR ", "ISO 2022 IR "}));
      set && (value != set->term || value.starts_with("GB")))
    return set;
  exact = false;
  std::string name;
  for (const char c : value)
    if (std::isalnum(std::uint8_t(c))) name += char(std::toupper(std::uint8_t(c)));
  for (const auto& [other, term] : otherNames)
    if (name == other) return setOf(term);
  return setOf(withoutPrefix(name, {"ISO2022IR", "ISOIR", "IR", "ISO"}));
}

/// SpecificCharacterSet, interpreted.
struct Characters {
  const CharacterSet* initial = &ascii;  ///< set in which text begins
  bool extensions = false;
  bool undeclared = true;     ///< no set for bytes above 7F is declared
  std::string misspelt;       ///< a value that is no term of the standard
  bool ofLaterValue = false;  ///< the first value has no letters above 7F, a later one has
};

/// Returns whether the set's bytes above 7F differ from ASCII without an escape sequence.
bool isUpperHalf(const CharacterSet& set) {
  const std::string_view escape = set.escape ? set.escape : "-";
  return escape.starts_with('-') || escape.starts_with(')') || escape.starts_with("$)");
}

Characters charactersOf(const std::string& specificCharacterSet) {
  Characters characters;
  std::size_t begin = 0;
  for (int number = 0; begin <= specificCharacterSet.size(); ++number) {
    const std::size_t end = std::min(specificCharacterSet.find('\\', begin), specificCharacterSet.size());
    std::string value = specificCharacterSet.substr(begin, end - begin);
    value.erase(value.find_last_not_of(' ') + 1);
    value.erase(0, std::min(value.find_first_not_of(' '), value.size()));
    begin = end + 1;
    bool exact = true;
    const CharacterSet* set = meantBy(value, exact);
    if (!exact && characters.misspelt.empty()) characters.misspelt = value;
    characters.extensions = number > 0;
    if (!set || set->term == std::string_view("6") || !characters.undeclared) continue;
    if (number > 0 && !isUpperHalf(*set)) continue;
    characters.initial = set;
    characters.undeclared = false;
    characters.ofLaterValue = number > 0;
  }
  return characters;
}

bool isPlain(const std::string& text) {
  return std::ranges::all_of(text, [](char c) { return std::uint8_t(c) < 0x80 && c != 0x1b; });
}

/// Returns the byte length of the shortest-form UTF-8 character at `at`, or 0 if there is none.
std::size_t utf8Length(std::string_view text, std::size_t at) {
  const auto first = std::uint8_t(text[at]);
  const std::size_t length = first < 0x80   ? 1
                             : first < 0xc2 ? 0
                             : first < 0xe0 ? 2
                             : first < 0xf0 ? 3
                             : first < 0xf5 ? 4
                                            : 0;
  if (text.size() - at < length) return 0;
  const auto second = length > 1 ? std::uint8_t(text[at + 1]) : 0;
  const bool tooLong = (first == 0xe0 && second < 0xa0) || (first == 0xf0 && second < 0x90);
  if (tooLong || (first == 0xed && second >= 0xa0) || (first == 0xf4 && second >= 0x90)) return 0;
  for (std::size_t n = 1; n < length; ++n)
    if ((std::uint8_t(text[at + n]) & 0xc0) != 0x80) return 0;
  return length;
}

/// The bytes above 7F of a text, read as UTF-8.
struct Utf8 {
  int characters = 0;
  bool whole = true;   ///< true if all of them are UTF-8
  bool mixed = false;  ///< a non-Latin letter touches an ASCII letter, which only happens by chance
};

/// Returns whether a two-byte UTF-8 character is neither Latin nor a combining accent.
bool isLetterOfOthers(std::uint8_t first) { return first >= 0xc9 && first != 0xcc && first != 0xcd; }

Utf8 utf8In(std::string_view text) {
  const auto isAscii = [&](std::size_t at) {
    return at < text.size() && std::isalpha(std::uint8_t(text[at]));
  };
  Utf8 found;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = utf8Length(text, at);
    found.whole = found.whole && length > 0;
    found.characters += length > 1;
    const bool other = length == 2 && isLetterOfOthers(std::uint8_t(text[at]));
    found.mixed = found.mixed || (other && (isAscii(at + 2) || (at > 0 && isAscii(at - 1))));
    at += std::max<std::size_t>(1, length);
  }
  return found;
}

/// Returns whether text that is valid UTF-8 cannot be text of the declared set. UTF-8 pairs ("\xc3\xa9") make
/// no sense in Latin sets; the other sets here have no letters at 80 .. 9F.
bool isNoTextOf(const CharacterSet& set, const std::string& text) {
  constexpr std::string_view latin[] = {"100", "101", "109", "110", "148", "203"},
                             other[] = {"144", "127", "126", "138", "166", "13"};
  if (std::ranges::find(latin, set.term) != std::end(latin)) return true;
  return std::ranges::find(other, set.term) != std::end(other) &&
         std::ranges::any_of(text, [](char c) { return std::uint8_t(c) >= 0x80 && std::uint8_t(c) < 0xa0; });
}

/// How text is read: as declared, or as its bytes suggest.
enum class ReadAs { declared, utf8, latin1 };

/// Returns how text is read if its bytes contradict the declaration. Text of another set is UTF-8 if all of
/// it is and the set cannot have it. If UTF-8 or nothing is declared, text with any UTF-8 is UTF-8, else
/// Latin-1, a guess.
ReadAs readAs(const std::string& text, const Characters& characters) {
  if (text.find('\x1b') != std::string::npos) return ReadAs::declared;
  const Utf8 bytes = utf8In(text);
  const bool isUtf8 = characters.initial->term == std::string_view("192");
  if (!characters.undeclared && !isUtf8)
    return bytes.whole && !bytes.mixed && isNoTextOf(*characters.initial, text) ? ReadAs::utf8
                                                                                : ReadAs::declared;
  if (bytes.characters > 0) return ReadAs::utf8;
  const bool hasControls =
      std::ranges::any_of(text, [](char c) { return std::uint8_t(c) >= 0x80 && std::uint8_t(c) < 0xa0; });
  return hasControls ? ReadAs::declared : ReadAs::latin1;
}

/// Returns the set that the escape sequence at `at` selects, with its `length`; null if unknown.
const CharacterSet* escapedSet(std::string_view text, std::size_t at, std::size_t& length) {
  for (const CharacterSet& set : sets) {
    if (!set.escape || !text.substr(at + 1).starts_with(set.escape)) continue;
    length = 1 + std::string_view(set.escape).size();
    return &set;
  }
  return nullptr;
}

/// Returns `bytes` in the encoding passed to iconv.
std::string encoded(std::string_view bytes, CharacterSet::Bytes how) {
  std::string out;
  for (std::size_t n = 0; n < bytes.size(); ++n) {
    const bool shifted = how != CharacterSet::asTheyAre && std::uint8_t(bytes[n]) > 0x20;
    if (shifted && how == CharacterSet::highBitsWithPrefix && n % 2 == 0) out += '\x8f';
    out += shifted ? char(bytes[n] | 0x80) : bytes[n];
  }
  return out;
}

constexpr const char* replacement = "\xef\xbf\xbd";

/// Returns whether workers (io/worker) can convert the encoding without being prepared for all.
bool isUsual(std::string_view encoding) {
  return encoding == "ASCII" || encoding == "ISO-8859-1" || encoding == "UTF-8";
}

/// Returns `bytes` in UTF-8, with U+FFFD for each byte that has no meaning.
std::string converted(std::string bytes, const char* encoding) {
  if (!isUsual(encoding)) worker::needAll();
  const iconv_t converter = iconv_open("UTF-8", encoding);
  if (converter == iconv_t(-1)) return replacement;
  std::string out;
  char* in = bytes.data();
  std::size_t left = bytes.size();
  while (left > 0) {
    std::array<char, 256> buffer;
    char* to = buffer.data();
    std::size_t room = buffer.size();
    const std::size_t result = iconv(converter, &in, &left, &to, &room);
    out.append(buffer.data(), to);
    if (result != std::size_t(-1) || to != buffer.data()) continue;
    out += replacement;
    ++in, --left;
  }
  iconv_close(converter);
  return out;
}

bool isDelimiter(char c) { return c == '^' || c == '=' || c == '\\' || c == '\r' || c == '\n'; }

}  // namespace

std::string toUtf8(const std::string& text, const std::string& specificCharacterSet) {
  if (isPlain(text)) return text;
  const Characters characters = charactersOf(specificCharacterSet);
  if (const ReadAs how = readAs(text, characters); how != ReadAs::declared)
    return converted(text, how == ReadAs::utf8 ? "UTF-8" : "ISO-8859-1");
  const CharacterSet* current = characters.initial;
  std::string out, run;
  const auto flush = [&] {
    out += converted(encoded(run, current->bytes), current->encoding);
    run.clear();
  };
  for (std::size_t at = 0; at < text.size();) {
    std::size_t length = 0;
    const CharacterSet* next = text[at] == 0x1b ? escapedSet(text, at, length) : nullptr;
    // A delimiter resets escape sequences (PS3.5 6.1.2.5.3). It can be a byte of a multi-byte character only
    // in sets without code extensions.
    if (!next && characters.extensions && isDelimiter(text[at]) &&
        current->bytes == CharacterSet::asTheyAre) {
      flush();
      current = characters.initial;
    }
    if (next) {
      flush();
      current = next;
      at += length;
    } else {
      run += text[at++];
    }
  }
  flush();
  return out;
}

std::optional<std::string> fromUtf8(const std::string& text, const std::string& specificCharacterSet) {
  if (isPlain(text)) return text;
  bool exact = true;
  const CharacterSet* set = meantBy(specificCharacterSet, exact);
  if (!exact || !set || set->bytes != CharacterSet::asTheyAre) return {};
  const iconv_t converter = iconv_open(set->encoding, "UTF-8");
  if (converter == iconv_t(-1)) return {};
  std::string in = text, out(4 * text.size(), '\0');
  char *from = in.data(), *to = out.data();
  std::size_t left = in.size(), room = out.size();
  const std::size_t changed = iconv(converter, &from, &left, &to, &room);
  iconv_close(converter);
  if (changed != 0 || left > 0) return {};
  out.resize(out.size() - room);
  if (toUtf8(out, specificCharacterSet) != text) return {};
  return out;
}

std::string characterRemark(const std::string& text, const std::string& specificCharacterSet) {
  if (isPlain(text)) return {};
  const Characters characters = charactersOf(specificCharacterSet);
  const std::string set = "SpecificCharacterSet \"" + toUtf8(specificCharacterSet, {}) + "\"";
  const std::string term = std::string("ISO_IR ") + characters.initial->term;
  const bool undeclared = characters.undeclared && characters.misspelt.empty();
  const std::string unknown =
      characters.undeclared ? "its " + set + " is no term of the standard and is not known" : "";
  const ReadAs how = readAs(text, characters);
  if (how == ReadAs::latin1) {
    const std::string guess = "were read as ISO_IR 100, which is a guess";
    if (undeclared) return "it has letters above 7F and does not say of which character set: they " + guess;
    if (characters.undeclared) return unknown + ": its texts " + guess;
    return "it has texts that are no UTF-8 under " + set + ": they " + guess;
  }
  if (how == ReadAs::utf8 && undeclared)
    return "it has texts in UTF-8 and does not say so: they were read as UTF-8";
  if (how == ReadAs::utf8 && characters.undeclared) return unknown + ": its texts were read as UTF-8";
  if (how == ReadAs::utf8 && term != "ISO_IR 192")
    return "it has texts in UTF-8 under " + set + ": they were read as UTF-8";
  if (!characters.misspelt.empty())
    return characters.undeclared ? unknown
                                 : "its " + set + " is no term of the standard: it was read as " + term;
  if (characters.ofLaterValue && text.find('\x1b') == std::string::npos)
    return "its " + set + " says nothing of letters above 7F in its first value: they were read as " + term;
  return {};
}

void loadCharacterSets(bool all) {
  // Closed converters might be unloaded, so these stay open.
  for (const CharacterSet& set : sets)
    if (all || isUsual(set.encoding)) (void)iconv_open("UTF-8", set.encoding);
}

}  // namespace volumen::dicom
