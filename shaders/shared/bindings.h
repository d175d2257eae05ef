// Binding numbers of descriptor set 0, one per buffer of the renderer: a kernel declares the ones it uses.
#ifndef LAVALIGHT_SHARED_BINDINGS_H
#define LAVALIGHT_SHARED_BINDINGS_H

// Scene, read only: RGBA32UI texel buffers (the fastest reads measured on lavapipe).
#define BINDING_BVH_NODES 0
#define BINDING_TRIANGLES 1
#define BINDING_TRIANGLE_NORMALS 2
#define BINDING_MATERIALS 3
#define BINDING_LIGHTS 4
#define BINDING_ALBEDO_TABLE 5
#define BINDING_PUNCTUALS 6
#define BINDING_LIGHT_TREE 7

// Wave state, one element per path slot.
#define BINDING_FRAME 8
#define BINDING_RAYS 9
#define BINDING_HITS 10
#define BINDING_PATHS 11
#define BINDING_SHADOW_RAYS 12
#define BINDING_QUEUES 13
#define BINDING_COUNTERS 14
#define BINDING_DISPATCH_SIZES 15
#define BINDING_LANES 19
#define BINDING_LANE_COUNTERS 20
#define BINDING_WAITING_PATHS 30
#define BINDING_PATH_LAYERS 34
#define BINDING_TRIANGLE_LAYERS 35
#define BINDING_SAMPLE_SURFACES 36

// Film of one band and what happened to it.
#define BINDING_FILM 16
#define BINDING_TALLIES 17

#define BINDING_ALBEDO_OUT 18

#define BINDING_VISIT_COUNTS 21

// Textures and what surfaces need for them, read only.
#define BINDING_PICTURES 22
#define BINDING_TEXTURES 23
#define BINDING_TRIANGLE_UVS 24
#define BINDING_TRIANGLE_COLORS 25
#define BINDING_TRIANGLE_TANGENTS 26
#define BINDING_ENVIRONMENT_MAP 27
#define BINDING_ENVIRONMENT_TABLE 28

#define BINDING_DISPLAY 29

#define BINDING_SOLIDS 31 // read only, as the scene's others

// Records of the schedule "hosted".
#define BINDING_RECORDS_IN 32
#define BINDING_RECORDS_OUT 33

// The accelerator "ray_query", read only.
#define BINDING_TRIANGLE_STRUCTURE 37
#define BINDING_STRUCTURE_EXTENT 38

#endif
