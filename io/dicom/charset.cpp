#include <iconv.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include "io/dicom/data_set.h"

namespace volumen::dicom {
namespace {

/// A character set of PS3.3 C.12.1.1.2: its defined term without "ISO_IR " or "ISO 2022 IR ", the escape
/// sequence that selects it (behind ESC), and how its bytes become an encoding that iconv knows.
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
    // ISO 2022 shifts the seven bits of these into GL; EUC writes them with the high bits set.
    {"87", "$B", "EUC-JP", CharacterSet::highBits},
    {"159", "$(D", "EUC-JP", CharacterSet::highBitsWithPrefix},
    {"149", "$)C", "EUC-KR"},
    {"58", "$)A", "GB2312"},
    {"192", nullptr, "UTF-8"},
    {"GB18030", nullptr, "GB18030"},
    {"GBK", nullptr, "GBK"},
};
constexpr const CharacterSet& ascii = sets[0];

/// The character set that text begins in: the first value of SpecificCharacterSet.
const CharacterSet& initialSet(const std::string& specificCharacterSet) {
  std::string term = specificCharacterSet.substr(0, specificCharacterSet.find('\\'));
  term.erase(term.find_last_not_of(' ') + 1);
  for (const char* prefix : {"ISO_IR ", "ISO 2022 IR "})
    if (term.starts_with(prefix)) term.erase(0, std::string_view(prefix).size());
  for (const CharacterSet& set : sets)
    if (term == set.term) return set;
  return ascii;
}

/// The set that the escape sequence at `at` selects, and the sequence's length; nothing where it is unknown.
const CharacterSet* escapedSet(std::string_view text, std::size_t at, std::size_t& length) {
  for (const CharacterSet& set : sets) {
    if (!set.escape || !text.substr(at + 1).starts_with(set.escape)) continue;
    length = 1 + std::string_view(set.escape).size();
    return &set;
  }
  return nullptr;
}

/// Bytes in the encoding that iconv is asked for.
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

/// `bytes` in UTF-8; each byte that has no meaning becomes U+FFFD.
std::string converted(std::string bytes, const char* encoding) {
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
  const bool plain =
      std::all_of(text.begin(), text.end(), [](char c) { return std::uint8_t(c) < 0x80 && c != 0x1b; });
  if (plain) return text;
  const CharacterSet& initial = initialSet(specificCharacterSet);
  const bool extensions = specificCharacterSet.find('\\') != std::string::npos;
  const CharacterSet* current = &initial;
  std::string out, run;
  const auto flush = [&] {
    out += converted(encoded(run, current->bytes), current->encoding);
    run.clear();
  };
  for (std::size_t at = 0; at < text.size();) {
    std::size_t length = 0;
    const CharacterSet* next = text[at] == 0x1b ? escapedSet(text, at, length) : nullptr;
    // A delimiter ends what escape sequences have selected (PS3.5 6.1.2.5.3); as a byte of a multi-byte
    // character it can only stand in sets without code extensions.
    if (!next && extensions && isDelimiter(text[at]) && current->bytes == CharacterSet::asTheyAre) {
      flush();
      current = &initial;
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

void loadCharacterSets() {
  // What is closed may be unloaded.
  for (const CharacterSet& set : sets) (void)iconv_open("UTF-8", set.encoding);
}

}  // namespace volumen::dicom
