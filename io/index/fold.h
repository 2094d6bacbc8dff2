#pragma once

#include <string>
#include <vector>

namespace volumen {

/// Returns text in its search form, UTF-8. Compatibility forms and accents are removed, letters are lower
/// case, "ß" is "ss". Separators of name parts (PS3.5 6.2, PN: ^ and =) and commas become spaces.
std::string folded(const std::string& utf8);

/// Returns the words of a search in their search form.
std::vector<std::string> foldedWords(const std::string& utf8);

/// Returns a LIKE pattern of SQL, with "\" as its escape, for texts that contain `text`.
std::string likePattern(const std::string& text);

}  // namespace volumen
