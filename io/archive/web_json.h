#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

class DcmDataset;

namespace volumen {

/// Returns the keys of a question as the resource and query of QIDO-RS (PS3.18 10.6): "/studies?00100020=1".
/// `limit` and `offset` count answers. Not all archives know the wildcard "?", so "*" takes its place. With
/// `isFuzzy` names have no wildcards, and fuzzy matching is asked for.
std::string searchTarget(DcmDataset& keys, int limit, int offset, bool isFuzzy = false);

/// Returns a path segment or a value of a query with all that is special in it encoded.
std::string percentEncoded(const std::string& text);

/// Fills a data set with those attributes of an answer (PS3.18 F.2) that `keys` asks for, in UTF-8. Values
/// that are not texts or numbers, or longer than 1024 bytes, are left out.
void putAnswer(const nlohmann::json& answer, DcmDataset& keys, DcmDataset& data);

}  // namespace volumen
