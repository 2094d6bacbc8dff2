#pragma once

#include <string>
#include <vector>

namespace volumen {

/// Text as it is searched for: compatibility forms and accents are taken away, capitals are small, "ß" is
/// "ss"; what separates parts of a name (PS3.5 6.2, PN: ^ and =) and commas are spaces. UTF-8.
std::string folded(const std::string& utf8);

/// The words of a search, folded.
std::vector<std::string> foldedWords(const std::string& utf8);

/// A date as people type and read it, "2026-11-24" for "20261124"; what is no such date as it is.
std::string withDashes(const std::string& date);

/// A pattern of SQL's LIKE, with "\" as its escape, for what holds `text`.
std::string likePattern(const std::string& text);

}  // namespace volumen
