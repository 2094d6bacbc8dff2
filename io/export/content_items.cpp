#include "io/export/content_items.h"

#include "io/export/dicom_modules.h"

namespace volumen {

namespace {

void addItem(const ContentItem& item, int depth, DicomElements& out) {
  if (*item.relationship) out.push_back({0x0040a010, item.relationship, 0, depth});
  out.push_back({0x0040a040, item.type, 0, depth});
  if (isWhole(item.name)) append(out, codeSequence(0x0040a043, item.name, depth));
  for (DicomElement e : item.value) {
    e.depth += depth;
    out.push_back(std::move(e));
  }
  if (!item.content.empty()) out.push_back({0x0040a730, {}, 0, depth});
  for (const ContentItem& below : item.content) {
    out.push_back({dicomItem, {}, 0, depth + 1});
    addItem(below, depth + 1, out);
  }
}

}  // namespace

DicomElements elementsOf(const ContentItem& root) {
  DicomElements all;
  addItem(root, 0, all);
  return all;
}

ContentItem containerItem(const char* relationship, const Code& name, const char* templateId) {
  ContentItem item{relationship, "CONTAINER", name, {{0x0040a050, "SEPARATE"}}};
  if (*templateId)
    append(item.value, {{0x0040a504, {}},
                        {dicomItem, {}, 0, 1},
                        {0x00080105, "DCMR", 0, 1},
                        {0x0040db00, templateId, 0, 1}});
  return item;
}

ContentItem conceptItem(const char* relationship, const Code& name, const Code& value) {
  return {relationship, "CODE", name, codeSequence(0x0040a168, value, 0)};
}

ContentItem textItem(const char* relationship, const Code& name, const std::string& text) {
  return {relationship, "TEXT", name, {{0x0040a160, text}}};
}

ContentItem uidItem(const char* relationship, const Code& name, const std::string& uid) {
  return {relationship, "UIDREF", name, {{0x0040a124, uid}}};
}

}  // namespace volumen
