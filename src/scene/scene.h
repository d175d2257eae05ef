// A scene as the renderer sees it: plain data in world space, whatever file it came from.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "image/image.h"
#include "image/picture.h"
#include "image/pixel_limit.h"
#include "image/texel.h"

namespace lavalight {

// What a picture is used for in a material; the order is that of kSlot... in shaders/shared/scene.h.
enum class TextureSlot : uint32_t {
    baseColor, // and alpha
    metallicRoughness,
    normal,
    emission,
    specular,
    specularColor, // with Material::isGlossiness, its alpha is 1 - roughness
    transmission,
    clearcoat,
    clearcoatRoughness,
    clearcoatNormal,
    sheenColor,
    sheenRoughness,
    anisotropy,
    iridescence,
    iridescenceThickness,
    diffuseTransmission,
    diffuseTransmissionColor,
};
constexpr size_t kTextureSlots = 17;

// A picture in one slot of a material. Texels multiply the slot's factors.
struct Texture {
    uint32_t picture = 0; // index into Scene::pictures
    uint32_t uvSet = 0;
    glm::vec3 uRow{1.0f, 0.0f, 0.0f}; // u = dot(uRow, (u, v, 1)) of the vertices' coordinates, v alike
    glm::vec3 vRow{0.0f, 1.0f, 0.0f};
    Wrap wrapU = Wrap::repeat;
    Wrap wrapV = Wrap::repeat;
    bool isNearest = false; // else bilinear
    bool isSrgb = false;    // colour channels hold sRGB; else linear values
};

enum class AlphaMode { opaque, mask, blend };

// No attenuation inside a solid.
constexpr float kNoAttenuation = std::numeric_limits<float>::infinity();

// Factors mean what glTF's and its extensions' properties of these names mean.
struct Material {
    std::string name;
    glm::vec3 baseColor{1.0f}; // linear Rec. 709
    float metallic = 1.0f;
    float roughness = 1.0f; // perceptual; alpha = roughness^2
    // Radiance, W/(sr m^2) per channel, towards the front (both sides if doubleSided).
    glm::vec3 emission{0.0f};
    float ior = 1.5f;      // from 1, or 0: KHR_materials_ior's special value, which makes F0 1
    float specular = 1.0f; // KHR_materials_specular; 0 makes the dielectric a pure Lambert surface
    glm::vec3 specularColor{1.0f};
    float transmission = 0.0f; // share of light that enters the surface instead of its base
    bool isSolid = false; // a transmissive surface is the boundary of a refracting body; else a thin wall
    bool doubleSided = false;

    AlphaMode alphaMode = AlphaMode::opaque;
    float alpha = 1.0f; // alpha of the base colour
    float alphaCutoff = 0.5f;
    bool isUnlit = false;      // sends its base colour to any ray, scatters nothing, is no light
    bool isGlossiness = false; // TextureSlot::specularColor says how

    glm::vec3 attenuationColor{1.0f}; // colour that white light has in a solid after attenuationDistance
    float attenuationDistance = kNoAttenuation;
    float dispersion = 0.0f; // 20 / Abbe number
    float clearcoat = 0.0f;
    float clearcoatRoughness = 0.0f;
    glm::vec3 sheenColor{0.0f};
    float sheenRoughness = 0.0f;
    float anisotropy = 0.0f;         // strength
    float anisotropyRotation = 0.0f; // radians, counter-clockwise from the tangent
    float iridescence = 0.0f;
    float iridescenceIor = 1.3f;
    float iridescenceThicknessMinimum = 100.0f; // nm
    float iridescenceThicknessMaximum = 400.0f; // nm
    float diffuseTransmission = 0.0f;
    glm::vec3 diffuseTransmissionColor{1.0f};

    float normalScale = 1.0f; // scale of TextureSlot::normal
    float clearcoatNormalScale = 1.0f;
    std::array<std::optional<Texture>, kTextureSlots> textures{}; // by TextureSlot
    [[nodiscard]] const std::optional<Texture>& texture(TextureSlot slot) const {
        return textures[static_cast<size_t>(slot)];
    }
};

// One primitive of one node, baked to world space. The front of a triangle is where its vertices turn
// counter-clockwise (mirroring transforms have been undone by swapping two vertices).
struct Mesh {
    std::string name;
    uint32_t material = 0; // index into Scene::materials
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals; // unit length, one per position; empty: flat shaded
    std::vector<glm::uvec3> triangles;
    std::vector<std::vector<glm::vec2>> uvs{}; // per set, one per position; a set that is not there is empty
    std::vector<glm::vec4> colors{};           // linear, multiply base colour and alpha; empty: none
    // Unit length, xyz towards growing u; w: 1 or -1, bitangent = w * cross(normal, tangent). Empty: none.
    std::vector<glm::vec4> tangents{};
    // Tangents for textures of its material whose coordinates go other ways: one list for each of
    // tangentSpaces() (scene/tangents.h) after the first, empty where the mesh lacks the coordinates. None:
    // those above serve all.
    std::vector<std::vector<glm::vec4>> furtherTangents{};
    uint32_t solid = 0;  // solid that it bounds, or helps to: 1 + an index into Scene::solids; 0: none
    uint32_t object = 0; // index into Scene::objects
};

// A panorama shows all directions, by the convention of environment maps.
enum class Projection { perspective, orthographic, panorama };

// The projection of a perspective camera in pixels of the image, as calibrations give it.
struct Intrinsics {
    glm::dvec2 focal{0.0};  // focal lengths to the right and down; equal where pixels are squares
    glm::dvec2 center{0.0}; // principal point: where the axis of the view meets the image, from its top left
    bool operator==(const Intrinsics&) const = default;
};

struct Camera {
    std::string name;
    Projection projection = Projection::perspective;
    glm::vec3 position{0.0f};
    glm::vec3 right{1.0f, 0.0f, 0.0f}; // orthonormal, right-handed: right x up = -forward
    glm::vec3 up{0.0f, 1.0f, 0.0f};
    glm::vec3 forward{0.0f, 0.0f, -1.0f};
    float verticalFov = 0.8f;             // perspective: full angle, radians
    std::optional<Intrinsics> intrinsics; // perspective: instead of verticalFov and framedAspect
    float halfHeight = 1.0f;              // orthographic: glTF's ymag, metres
    std::optional<float> aspect;          // width / height that the file asks for
    // What this wide an image shows stays in the picture: a narrower one shows more height. 0: it shows less
    // width.
    float framedAspect = 0.0f;
    // Camera rays see what is at these distances along `forward`, metres; panoramas see everything.
    float znear = 0.0f;
    float zfar = std::numeric_limits<float>::infinity();
    float lensRadius = 0.0f;    // perspective: metres; 0: all is sharp
    float focusDistance = 1.0f; // metres along `forward` to the plane that is sharp
    bool operator==(const Camera&) const = default;
};

// A disc in the environment, far away.
struct SunDisc {
    glm::vec3 direction{0.0f, 1.0f, 0.0f}; // towards its middle, unit length
    glm::vec3 radiance{0.0f};              // added to the environment's
    float size = 0.0f;                     // 1 - the cosine of its angular radius
};

// Radiance from all directions, as an equirectangular picture: the middle of its top row is +Y, the middle of
// the picture is +X, and +Z lies a quarter of its width to the right of that.
struct EnvironmentMap {
    std::string source;     // file, or the name of a procedural one
    Image image;            // finite, not negative
    uint64_t badTexels = 0; // texels that were infinite, NaN or negative, and had to be changed
    std::optional<SunDisc> sun{};
};

// Light that reaches everything.
constexpr float kNoRange = std::numeric_limits<float>::infinity();

enum class PunctualKind { point, spot, directional };

// A light without size. Photometric units are taken as radiometric ones, 1 lm = 1 W.
struct PunctualLight {
    std::string name;
    PunctualKind kind = PunctualKind::point;
    glm::vec3 position{0.0f};
    glm::vec3 direction{0.0f, 0.0f, -1.0f}; // unit length, the way it shines
    glm::vec3 intensity{1.0f};              // W/sr; directional: W/m^2
    float innerConeAngle = 0.0f;            // spot, radians from the axis: full intensity inside
    float outerConeAngle = 0.7853982f;      // nothing outside
    float range = kNoRange; // point and spot, metres: KHR_lights_punctual's window ends the light there
};

// What a file can play; Scene holds one moment of it.
struct Animation {
    std::string name;
    float seconds = 0.0f; // the time of its last key
};

struct Bounds {
    glm::vec3 lower{0.0f};
    glm::vec3 upper{0.0f};
    [[nodiscard]] glm::vec3 center() const { return 0.5f * (lower + upper); }
    [[nodiscard]] float radius() const { return 0.5f * glm::length(upper - lower); }
};

// A closed body with an inside (KHR_materials_volume).
struct Solid {
    uint32_t mesh = 0; // the first of the meshes that bound it, whose material says what it is filled with
    Bounds bounds;
};

// The most triangles of a scene: three 16-byte texels each must fit into a texel buffer.
constexpr uint64_t kMostTriangles = kMostTexels / 3;

// The most bytes of all pictures of a scene, which share one texel buffer.
constexpr uint64_t kMostPictureBytes = kMostTexels * 16;

// Metres from the origin in each coordinate. Squares of distances up to here, which bounds and falloff need,
// stay finite in single precision.
constexpr float kLargestPosition = 1e18f;

// Geometry that is small for where it lies. Metres.
struct CoarseGeometry {
    double distance = 0.0;   // from the scene's origin
    double resolution = 0.0; // steps of coordinates there
    double size = 0.0;       // what is resolved by them
};

// What moves until the next frame of an animation.
struct NextFrame {
    std::vector<std::vector<glm::vec3>> positions; // of each mesh, as Mesh::positions, from the same origin
    Camera camera;
};

struct Scene {
    std::string source; // file or built-in name
    // Where (0, 0, 0) of everything below lies in the file's world. All that people read or write of places
    // is in the world's coordinates.
    glm::dvec3 origin{0.0};
    std::vector<Mesh> meshes;
    std::vector<std::string> objects; // names of what meshes are parts of: of the file's nodes
    std::optional<NextFrame> next;    // none: nothing is known of it, or nothing moves
    std::vector<Material> materials;  // never empty: meshes without one use a default material
    std::vector<Picture> pictures;
    std::vector<Camera> cameras; // never empty after import: one that frames the scene stands in
    bool hasOwnCamera = true;    // false: it is the stand-in, which moves with what it frames
    std::vector<PunctualLight> punctualLights;
    std::vector<Animation> animations;
    bool hasOwnLight = true;      // false: its environment is white, until a caller brings light
    bool hasStandInLight = false; // that the caller brought unasked; it enters the bias ledger
    glm::vec3 environment{0.0f};  // constant radiance from every direction that hits nothing
    std::optional<EnvironmentMap> environmentMap; // instead of it
    Bounds bounds;                                // bounds of everything but a ground that --ground adds
    float reach = 0.0f;        // distance from their centre that everything is within, where that is more
    float groundHeight = 0.0f; // y of the ground that catches shadows, for renders where one does
    std::vector<Solid> solids; // findSolids() fills this and the next; the smallest bounds first
    std::vector<std::string> openSolids;        // names of meshes that ought to bound a body and do not
    std::optional<CoarseGeometry> coarse;       // the worst of it, if there is any; it enters the bias ledger
    std::vector<std::string> warnings;          // what was not understood, one line each, with names
    std::vector<std::string> ignoredExtensions; // exact names; they enter the bias ledger
    std::vector<std::string> extensionsUsed;    // exact names as the file lists them
    std::vector<std::string> variants;          // names of the material variants
    std::vector<std::string> scenes;            // names of all scenes of the file
    size_t shownScene = 0;                      // the one of them that this is

    [[nodiscard]] uint64_t triangleCount() const {
        uint64_t count = 0;
        for (const Mesh& mesh : meshes)
            count += mesh.triangles.size();
        return count;
    }
};

} // namespace lavalight
