#pragma once

#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <vector>

class DcmItem;

namespace volumen {

/// An element of a data set as text, to be written to a file. In a list, the items of a sequence follow it.
/// Each item begins with an element `dicomItem`; `depth` is the number of enclosing items.
struct DicomElement {
  std::uint32_t tag = 0;  ///< group << 16 | element
  std::string value;      ///< UTF-8; several values are separated by backslashes; numbers are decimals
  std::uint16_t vr = 0;   ///< first letter << 8 | second; 0: taken from the dictionary
  int depth = 0;
  bool operator==(const DicomElement&) const = default;
};
using DicomElements = std::vector<DicomElement>;

inline constexpr std::uint32_t dicomItem = 0xfffee000;

inline void append(DicomElements& all, const DicomElements& more) {
  all.insert(all.end(), more.begin(), more.end());
}

/// Returns the shortest decimal string (VR DS, at most 16 characters) that is nearest to a number.
std::string decimal(double value);
/// Returns several decimal strings, separated by backslashes.
std::string decimals(std::initializer_list<double> values);

/// Returns a text as one line of at most 64 characters (VR LO); a backslash, which would separate two values,
/// becomes a blank. What is cut off takes blanks and commas before it along.
std::string inOneLine(const std::string& text);

/// Returns the value of a top-level element of the list, or an empty string if it is missing.
std::string valueOf(std::span<const DicomElement> elements, std::uint32_t tag);

/// Puts elements into a data set and replaces those already there, except by empty values.
/// Leaves out elements that cannot be written (an unknown VR, an invalid number).
void put(std::span<const DicomElement> elements, DcmItem& into);

}  // namespace volumen
