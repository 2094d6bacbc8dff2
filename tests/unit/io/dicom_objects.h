#pragma once

#include <functional>
#include <string>
#include <vector>

class DcmItem;

namespace volumen::tests {

/// SOP classes of objects that refer to pictures.
inline constexpr const char *presentationClass = "1.2.840.10008.5.1.4.1.1.11.1",
                            *keyObjectClass = "1.2.840.10008.5.1.4.1.1.88.59",
                            *reportClass = "1.2.840.10008.5.1.4.1.1.88.33",
                            *structureSetClass = "1.2.840.10008.5.1.4.1.1.481.3",
                            *segmentationClass = "1.2.840.10008.5.1.4.1.1.66.4";

/// Writes an object of this class with the attributes that `edit` adds. `implicitVr` selects implicit VR
/// little endian.
void writeObject(const std::string& path, const char* sopClassUid, const std::function<void(DcmItem&)>& edit,
                 bool implicitVr = false);

/// Appends an item to a sequence, which is created if missing, and returns it.
DcmItem& addItem(DcmItem& in, unsigned group, unsigned element);
/// Add attributes with text, numbers of VR FL or a 16-bit word.
void put(DcmItem& in, unsigned group, unsigned element, const std::string& value);
void putFloats(DcmItem& in, unsigned group, unsigned element, const std::vector<float>& values);
void putWord(DcmItem& in, unsigned group, unsigned element, unsigned value);

}  // namespace volumen::tests
