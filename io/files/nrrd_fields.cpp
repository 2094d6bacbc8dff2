#include <algorithm>
#include <iterator>

#include "io/files/header_text.h"
#include "io/files/nrrd.h"

namespace volumen {

namespace {

std::optional<SampleType> nrrdType(const std::string& name) {
  static const std::map<std::string, SampleType> types = [] {
    using enum SampleType;
    std::map<std::string, SampleType> all{{"signed char", int8},
                                          {"int8", int8},
                                          {"int8_t", int8},
                                          {"uchar", uint8},
                                          {"unsigned char", uint8},
                                          {"uint8", uint8},
                                          {"uint8_t", uint8},
                                          {"longlong", int64},
                                          {"long long", int64},
                                          {"long long int", int64},
                                          {"signed long long", int64},
                                          {"signed long long int", int64},
                                          {"int64", int64},
                                          {"int64_t", int64},
                                          {"ulonglong", uint64},
                                          {"unsigned long long", uint64},
                                          {"unsigned long long int", uint64},
                                          {"uint64", uint64},
                                          {"uint64_t", uint64},
                                          {"float", float32},
                                          {"double", float64},
                                          {"int", int32},
                                          {"signed int", int32},
                                          {"int32", int32},
                                          {"int32_t", int32},
                                          {"uint", uint32},
                                          {"unsigned int", uint32},
                                          {"uint32", uint32},
                                          {"uint32_t", uint32},
                                          {"short", int16},
                                          {"short int", int16},
                                          {"signed short", int16},
                                          {"signed short int", int16},
                                          {"int16", int16},
                                          {"int16_t", int16},
                                          {"ushort", uint16},
                                          {"unsigned short", uint16},
                                          {"unsigned short int", uint16},
                                          {"uint16", uint16},
                                          {"uint16_t", uint16}};
    return all;
  }();
  const auto found = types.find(name);
  if (found == types.end()) return {};
  return found->second;
}

// "Space Origin" and "spaceorigin" are one field; some fields have a second name.
std::string fieldName(std::string_view text) {
  std::string name = lowerCase(text);
  std::erase(name, ' ');
  if (name == "centers") return "centerings";
  return name;
}

struct HeaderText {
  std::string text;          // header without the line that ends it
  std::uint64_t dataOffset;  // start of attached data
  bool ended = false;        // ended by an empty line
};

}  // namespace

bool isNrrdHead(const std::string& head) {
  return head.starts_with("NRRD000") || head.starts_with("NRRD00.01");  // second form: first version
}

namespace {

Result<HeaderText> readText(const std::string& path) {
  auto head = readHead(path, mostHeaderBytes);
  if (!head) return head.error();
  if (!isNrrdHead(*head))
    return Error{path + " is not a NRRD file: it does not begin with NRRD000 and a version."};
  std::size_t end = head->find("\n\n"), blank = 2;
  if (const std::size_t crlf = head->find("\n\r\n"); crlf < end) end = crlf, blank = 3;
  if (end != std::string::npos) return HeaderText{head->substr(0, end), end + blank, true};
  if (head->size() == mostHeaderBytes)
    return Error{path + " has a header of more than 1 MiB, which is more than volumen reads."};
  return HeaderText{*head, head->size(), false};
}

// In values of keys \\n is a line end and \\\\ a backslash.
std::string unescaped(std::string_view text) {
  std::string plain;
  for (std::size_t n = 0; n < text.size(); ++n) {
    const bool escape = text[n] == '\\' && n + 1 < text.size() && (text[n + 1] == 'n' || text[n + 1] == '\\');
    if (escape) ++n;
    plain += escape && text[n] == 'n' ? '\n' : text[n];
  }
  return plain;
}

Status parseLines(std::string_view text, NrrdHeader& header, std::vector<std::string>& listed,
                  const std::string& path) {
  takeLine(text);  // NRRD000n
  while (!text.empty()) {
    const std::string_view line = takeLine(text);
    if (line.empty() || line[0] == '#') continue;
    const std::size_t colon = line.find(':');
    const char next = colon + 1 < line.size() ? line[colon + 1] : ' ';
    if (colon == std::string_view::npos || (next != '=' && next != ' ' && next != '\t'))
      return Error{path + " has a header line that is neither a field nor a key: '" + fieldText(line) + "'."};
    if (next == '=') {
      header.keyValues.emplace(line.substr(0, colon), unescaped(line.substr(colon + 2)));
      continue;
    }
    const std::string name = fieldName(line.substr(0, colon));
    const std::string value(trimmed(line.substr(colon + 1)));
    if (!header.fields.emplace(name, value).second)
      return Error{path + " gives the field '" + fieldText(name) + "' twice."};
    if (name == "datafile" && (value == "LIST" || value.starts_with("LIST "))) {
      // All following lines are names.
      while (!text.empty())
        if (const auto file = trimmed(takeLine(text)); !file.empty()) listed.emplace_back(file);
    }
  }
  return {};
}

Status findFiles(NrrdHeader& header, const HeaderText& text, std::vector<std::string> names,
                 const std::string& path) {
  const std::string dataFile = header.field("datafile");
  if (dataFile.empty()) {
    if (!text.ended) return Error{path + " is cut off: its header neither ends nor names a data file."};
    header.data.files = {path};
    header.data.offset = text.dataOffset;
    return {};
  }
  const auto parts = words(dataFile);
  if (dataFile != "LIST" && !dataFile.starts_with("LIST ")) {
    names = {dataFile};
    if (parts.size() >= 4 && parts[0].find('%') != std::string::npos) {
      auto all = expandPattern({parts.begin(), parts.begin() + 4}, path);
      if (!all) return all.error();
      names = *all;
    }
  }
  return setDataFiles(header.data, names, path);
}

Status parseEncoding(NrrdHeader& header, const std::string& path) {
  const std::string name = lowerCase(header.field("encoding"));
  SampleData& data = header.data;
  if (name == "gzip" || name == "gz")
    data.encoding = Encoding::deflate;
  else if (name == "hex")
    data.encoding = Encoding::hex;
  else if (name == "ascii" || name == "text" || name == "txt")
    data.text = true;
  else if (name == "bzip2" || name == "bz2")
    data.encoding = Encoding::bzip2;
  else if (name != "raw")
    return Error{path + " has the unknown encoding '" + fieldText(name) + "'."};

  const std::string endian = lowerCase(header.field("endian"));
  data.bigEndian = endian == "big";
  if (endian != "big" && endian != "little" && !data.text && bytesOf(data.type) > 1)
    return Error{path + " does not say the byte order of its samples ('endian: little' or 'endian: big')."};

  constexpr std::int64_t largest = std::int64_t(1) << 40;
  const std::string lines = header.field("lineskip"), bytes = header.field("byteskip");
  const auto lineSkip = lines.empty() ? 0 : toInteger(lines), byteSkip = bytes.empty() ? 0 : toInteger(bytes);
  if (!lineSkip || *lineSkip < 0 || *lineSkip > (1 << 20))
    return Error{path + " has the line skip '" + fieldText(lines) + "'; a number from 0 on is meant."};
  const bool fromEnd = byteSkip == -1 && !data.text && data.encoding != Encoding::hex;
  if (!byteSkip || (*byteSkip < 0 && !fromEnd) || *byteSkip > largest)
    return Error{path + " has the byte skip '" + fieldText(bytes) +
                 "'; a number from 0 on is meant, or -1 for data at the end."};
  data.lineSkip = int(*lineSkip);
  data.byteSkip = *byteSkip;
  return {};
}

}  // namespace

std::string NrrdHeader::field(const std::string& name) const {
  const auto found = fields.find(name);
  return found == fields.end() ? std::string() : found->second;
}

Result<NrrdHeader> readNrrdFields(const std::string& path) {
  auto text = readText(path);
  if (!text) return text.error();
  NrrdHeader header;
  std::vector<std::string> listed;
  if (Status s = parseLines(text->text, header, listed, path); !s) return s.error();

  constexpr std::int64_t mostAxes = 16;
  const auto dimension = toInteger(header.field("dimension"));
  const auto sizes = toSizes(header.field("sizes"));
  if (!dimension || *dimension < 1 || *dimension > mostAxes)
    return Error{path + " has the dimension '" + fieldText(header.field("dimension")) +
                 "'; 1 to 16 is meant."};
  if (!sizes || std::int64_t(sizes->size()) != *dimension)
    return Error{path + " has the sizes '" + fieldText(header.field("sizes")) + "', which are not " +
                 std::to_string(*dimension) + " whole numbers from 1 on."};
  header.sizes = *sizes;

  const auto type = nrrdType(lowerCase(header.field("type")));
  if (!type)
    return Error{path + " has samples of type '" + fieldText(header.field("type")) +
                 "', which volumen does not read."};
  header.data.type = *type;
  if (Status s = parseEncoding(header, path); !s) return s.error();
  if (Status s = findFiles(header, *text, std::move(listed), path); !s) return s.error();
  return header;
}

}  // namespace volumen
