// The streams that a program is started with.
#pragma once

namespace lavalight {

// Opens those of stdin, stdout and stderr that the caller left closed, so that no file gets their numbers
// and, with them, what is written to the streams. stdout then fails when it is written to, as it does where
// it is closed. Call it before anything opens files.
void holdStandardStreams();

} // namespace lavalight
