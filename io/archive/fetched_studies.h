#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/study/study.h"
#include "viewer/volume/result.h"

namespace volumen {

// The folder of fetched studies (fetchedFolder()) is kept below a size. Only what came from an archive may
// go: each such study has a mark in "fetched.marks" beside that folder, made before its first image, with its
// UID in it; the mark's time is that of the last use. A second one, "NAME.kept", keeps a study. A study
// without a mark was received, or is older than marks, and stays.

/// Marks a study that is about to be fetched into `studyFolder`, unless something is there already without a
/// mark. Until this program ends, no program removes it (of the last 256 that it uses). The Error: the folder
/// cannot be written.
Status beginFetched(const std::string& studyFolder, const std::string& studyUid);

/// Notes that files are used: those of fetched studies stay until this program ends, as above.
void useFetched(const std::vector<std::string>& files);
void useFetched(const Study& study);

/// Makes the folder of a series for images that a peer sends, below that of its study in `folder`. The study
/// loses its mark: nobody else may have them. The Error: the folder cannot be made.
Status beginReceived(const std::string& folder, const std::string& study, const std::string& series);

/// Keeps a fetched study, or lets trimFetched() remove it again, in all programs from now on. The Error: it
/// was not fetched, or the mark cannot be written.
Status keepFetched(const std::string& indexFolder, const std::string& studyUid, bool isKept);

/// Returns whether a fetched study is kept (keepFetched()); nothing for a study that trimFetched() never
/// removes, or that is not here.
std::optional<bool> isFetchedKept(const std::string& indexFolder, const std::string& studyUid);

/// Returns the UIDs of all kept studies, sorted.
std::vector<std::string> keptStudies(const std::string& indexFolder);

/// Removes fetched studies from the disk and the index in `indexFolder`, those unused for the longest time
/// first, until the others have at most `mostBytes` (0: no limit). Studies that a program uses stay. Kept
/// ones stay, too, and their size does not count. Returns the UIDs of the removed ones. The Error: the index
/// cannot be written.
Result<std::vector<std::string>> trimFetched(const std::string& indexFolder, std::uint64_t mostBytes);

}  // namespace volumen
