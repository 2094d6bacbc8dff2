#pragma once

namespace volumen {

struct Cine;

/// Where a clip of `count` frames that began with frame `first` is after so many ms: as fast as its file
/// says, from the last frame on to the first one again, or back and forth.
int cineFrame(const Cine& cine, int count, int first, double ms);

/// Frames a second as the file says; 15 where it does not.
double cineRate(const Cine& cine);

}  // namespace volumen
