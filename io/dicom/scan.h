#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/dicom/bytes.h"
#include "viewer/volume/result.h"

namespace volumen::dicom {

/// The encoding of a data set (PS3.5 7.1, annex A).
struct Encoding {
  bool explicitVr = true;
  bool bigEndian = false;
};

/// The file meta information (PS3.10 7.1).
struct MetaHeader {
  bool magic = false;             ///< "DICM" at 128
  std::string transferSyntaxUid;  ///< (0002,0010), empty if missing
  std::uint64_t dataSet = 0;      ///< offset of the data set
};

/// One element, item or sequence with its place in the bytes. Lists of elements are flat and in file order.
/// The contents of element n (items of a sequence, elements of an item) are the entries n + 1 .. end - 1.
struct Element {
  std::uint32_t tag = 0;  ///< group << 16 | element
  std::uint16_t vr = 0;   ///< first letter << 8 | second; 0 if not written
  bool bigEndian = false;
  std::uint32_t end = 0;     ///< index of the entry after its contents
  std::uint64_t offset = 0;  ///< offset of its value
  std::uint64_t length = 0;  ///< length of its value; undefinedLength if the file says so
};

inline constexpr std::uint64_t undefinedLength = 0xffffffff;
/// Tags that delimit items and sequences (PS3.5 7.5).
inline constexpr std::uint32_t itemTag = 0xfffee000, itemEndTag = 0xfffee00d, sequenceEndTag = 0xfffee0dd;
inline constexpr std::uint16_t vrOf(char a, char b) { return std::uint16_t(a << 8 | b); }

/// The result of a pass over a data set.
struct DataSetScan {
  std::vector<Element> elements;
  std::optional<Element> pixels;  ///< (7FE0,0008), (7FE0,0009) or (7FE0,0010), where the pass ends
  /// If not 0, the given bytes end too early and the pass needs at least this many.
  std::uint64_t needsUpTo = 0;
  std::uint64_t end = 0;  ///< where the pass ended: after the last element, or before the pixel data
};

/// Returns whether "DICM" is at 128.
bool hasMagic(Bytes head);

/// Reads the file meta information from the first bytes of a file of `fileSize` bytes. Files without preamble
/// get magic = false and the offset where their data set may begin. The meta header is limited to 1 MiB.
Result<MetaHeader> scanMeta(Bytes head, std::uint64_t fileSize);

/// Returns the encoding of the data set at `offset`, judged by its first element. `expected` decides
/// ambiguous cases.
Encoding encodingFound(Bytes head, std::uint64_t offset, Encoding expected);

/// Scans a data set up to its pixel data in one pass, without recursion and without trusting a length. Every
/// value must end inside its parent. Limits are depth 64 and 1,000,000 elements and items; group 0000 is an
/// error. `head` holds the first bytes of `fileSize`. An Error says what is wrong and where. `before` then
/// receives the elements before it.
Result<DataSetScan> scanDataSet(Bytes head, std::uint64_t offset, std::uint64_t fileSize, Encoding encoding,
                                DataSetScan* before = nullptr);

/// Returns whether the VR has a four-byte length after two reserved bytes (PS3.5 7.1.2).
bool hasLongLength(std::uint16_t vr);

/// Returns "(0028,0010)".
std::string tagText(std::uint32_t tag);

}  // namespace volumen::dicom
