// Joins films that hold different samples of one image.
#pragma once

#include <string>

#include "film/film_file.h"
#include "film/film_identity.h"

namespace lavalight {

// A film file and its name, for messages.
struct NamedFilm {
    std::string name;
    FilmFile file;
};

// Adds the samples of `part`, or puts it beside the others where it is another window of the image: film,
// tallies and header become those of one render of all samples, but for the seconds, which add up. Ranges may
// leave gaps between them: no estimator asks which samples there are. Throws Error, naming what is in the
// way, where the two are of different images, have samples in common, or lack some of those that they are to
// hold. Films of different kinds of machine are joined where that is said to be all right: each sample counts
// as any other, and the ledger names the kinds.
void join(NamedFilm& sum, const NamedFilm& part, Machines machines = Machines::ofOneKind);

} // namespace lavalight
