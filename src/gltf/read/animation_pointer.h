// KHR_animation_pointer: animated members of a document, such as colours of materials and angles of cameras.
#pragma once

#include "gltf/file/document.h"
#include "gltf/import_options.h"
#include "gltf/read/notes.h"

namespace lavalight {

// Sets what channels with pointers animate to its value at options.seconds, in the document itself, so that
// all that is read from it later is of that time. Pointers to what is not read, or not there, are noted by
// their text. Without a time nothing is set. Throws as poseAt does, and Error for values that are not finite.
void applyAnimationPointers(GltfDocument& document, const ImportOptions& options, GltfNotes& notes);

} // namespace lavalight
