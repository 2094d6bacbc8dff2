#include "io/archive/web_json.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcdatset.h>
#include <dcmtk/dcmdata/dcdeftag.h>
#include <dcmtk/dcmdata/dcelem.h>

#include <QByteArray>
#include <algorithm>
#include <cstdio>
#include <functional>
#include <nlohmann/json.hpp>

#include "io/archive/data_sets.h"

namespace volumen {

namespace {

// Names have up to 3 groups of 64 characters (PS3.5 6.2), and all else that is asked for is shorter.
constexpr std::size_t mostBytesOfValue = 1024;

std::string hexOf(const DcmTagKey& tag) {
  char text[9];
  std::snprintf(text, sizeof text, "%04X%04X", tag.getGroup(), tag.getElement());
  return text;
}

std::string valueOf(DcmDataset& data, const DcmTagKey& tag) {
  OFString value;
  data.findAndGetOFStringArray(tag, value);
  return {value.c_str(), value.length()};
}

void forEachKey(DcmDataset& keys, const std::function<void(const DcmTagKey&)>& visit) {
  for (unsigned long n = 0; n < keys.card(); ++n) visit(keys.getElement(n)->getTag().getXTag());
}

// PN comes as an object of its groups, or as a text; numbers come as numbers, or as texts.
std::string textOf(const nlohmann::json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_integer()) return std::to_string(value.get<std::int64_t>());
  if (value.is_number()) {
    char text[32];
    std::snprintf(text, sizeof text, "%.10g", value.get<double>());
    return text;
  }
  if (!value.is_object()) return {};
  std::string name;
  for (const char* group : {"Alphabetic", "Ideographic", "Phonetic"}) {
    const auto found = value.find(group);
    name += std::string(name.empty() && std::string_view(group) == "Alphabetic" ? "" : "=") +
            (found != value.end() && found->is_string() ? found->get<std::string>() : "");
  }
  while (name.ends_with('=')) name.pop_back();
  return name;
}

}  // namespace

std::string percentEncoded(const std::string& text) {
  return QByteArray::fromStdString(text).toPercentEncoding("*").toStdString();
}

std::string searchTarget(DcmDataset& keys, int limit, int offset, bool isFuzzy) {
  const std::string level = valueOf(keys, DCM_QueryRetrieveLevel);
  std::string target = "/studies";
  if (level != "STUDY") target += "/" + percentEncoded(valueOf(keys, DCM_StudyInstanceUID)) + "/series";
  if (level == "IMAGE") target += "/" + percentEncoded(valueOf(keys, DCM_SeriesInstanceUID)) + "/instances";
  target += "?limit=" + std::to_string(limit) + "&offset=" + std::to_string(offset);
  forEachKey(keys, [&](const DcmTagKey& tag) {
    const bool isInPath = (tag == DCM_StudyInstanceUID && level != "STUDY") ||
                          (tag == DCM_SeriesInstanceUID && level == "IMAGE");
    if (isInPath || tag == DCM_SpecificCharacterSet || tag == DCM_QueryRetrieveLevel) return;
    std::string value = valueOf(keys, tag);
    std::ranges::replace(value, '?', '*');
    if (isFuzzy && tag == DCM_PatientName) std::erase(value, '*');
    target += value.empty() ? "&includefield=" + hexOf(tag) : "&" + hexOf(tag) + "=" + percentEncoded(value);
  });
  return target + (isFuzzy ? "&fuzzymatching=true" : "");
}

void putAnswer(const nlohmann::json& answer, DcmDataset& keys, DcmDataset& data) {
  putKey(data, DCM_SpecificCharacterSet, "ISO_IR 192");
  if (!answer.is_object()) return;
  forEachKey(keys, [&](const DcmTagKey& tag) {
    const auto found = answer.find(hexOf(tag));
    if (tag == DCM_SpecificCharacterSet || found == answer.end() || !found->is_object()) return;
    const auto value = found->find("Value");
    if (value == found->end()) return;
    std::string text;
    if (value->is_array())
      for (const nlohmann::json& one : *value) {
        text += (text.empty() ? "" : "\\") + textOf(one);
        if (text.size() > mostBytesOfValue) break;
      }
    else
      text = textOf(*value);
    if (text.size() <= mostBytesOfValue) putKey(data, tag, text);
  });
}

}  // namespace volumen
