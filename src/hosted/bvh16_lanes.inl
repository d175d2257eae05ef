// Vectors of LANES floats, and what one ray or rays side by side are tested with: boxes and triangles.
// Included by bvh16_traversal.inl alone.

using Floats = float __attribute__((vector_size(4 * LANES)));
using Ints = int32_t __attribute__((vector_size(4 * LANES)));

template <size_t kLanes>
LAVALIGHT_TARGET inline Floats load(const std::array<float, kLanes>& floats, uint32_t part) {
    Floats lanes;
    std::memcpy(&lanes, floats.data() + part * LANES, sizeof lanes);
    return lanes;
}

template <size_t kLanes>
LAVALIGHT_TARGET inline Ints load(const std::array<uint32_t, kLanes>& words, uint32_t part) {
    Ints lanes;
    std::memcpy(&lanes, words.data() + part * LANES, sizeof lanes);
    return lanes;
}

template <size_t kLanes>
LAVALIGHT_TARGET inline void store(std::array<float, kLanes>& floats, uint32_t part, Floats lanes) {
    std::memcpy(floats.data() + part * LANES, &lanes, sizeof lanes);
}

// These take numbers of one ray, or of several rays side by side.
LAVALIGHT_TARGET inline Floats larger(Floats a, Floats b) {
    return a > b ? a : b;
}

inline float larger(float a, float b) {
    return a > b ? a : b;
}

LAVALIGHT_TARGET inline Floats smaller(Floats a, Floats b) {
    return a < b ? a : b;
}

LAVALIGHT_TARGET inline Floats magnitude(Floats lanes) {
    return reinterpret_cast<Floats>(reinterpret_cast<Ints>(lanes) & 0x7fffffff);
}

inline float magnitude(float number) {
    return std::abs(number);
}

// The first number must not be negative.
LAVALIGHT_TARGET inline Floats withSignOf(Floats lanes, Floats sign) {
    return reinterpret_cast<Floats>(reinterpret_cast<Ints>(lanes) |
                                    (reinterpret_cast<Ints>(sign) & std::numeric_limits<int32_t>::min()));
}

inline float withSignOf(float number, float sign) {
    return std::copysign(number, sign);
}

// What boxes and triangles are tested with, for one ray or rays side by side.
template <typename Real>
struct RaySetup {
    // The origin, moved towards the near planes of boxes and away from the far ones by the tolerance.
    Real nearOrigin[3], farOrigin[3];
    Real inverse[3];          // of the direction
    Real origin[3], shear[3]; // ShearedRay of shaders/lib/math/ray_triangle.glsl, turned

    // Changes the direction, as withoutZeros() of shaders/lib/math/ray_direction.glsl does.
    LAVALIGHT_TARGET void set(const Real (&from)[3], Real (&direction)[3], const Bounds& bounds) {
        const Real smallest = Real{} + kSmallestDirection;
        for (Real& along : direction)
            along = magnitude(along) < smallest ? withSignOf(smallest, along) : along;
        setSlabs(from, direction, bounds);
        setShear(from, direction);
    }

  private:
    LAVALIGHT_TARGET void setSlabs(const Real (&from)[3], const Real (&direction)[3], const Bounds& bounds) {
        Real reach = {};
        for (int axis = 0; axis < 3; ++axis)
            reach = larger(reach, larger(magnitude(from[axis] - bounds.lower[axis]),
                                         magnitude(bounds.upper[axis] - from[axis])));
        for (size_t axis = 0; axis < 3; ++axis) {
            // Far from the world's origin the sum would lose the tolerance. It does not lose two units in the
            // last place.
            const Real shift = kPlaneTolerance * reach + magnitude(from[axis]) * 0x1p-22f;
            const Real away = withSignOf(shift, direction[axis]);
            nearOrigin[axis] = from[axis] + away;
            farOrigin[axis] = from[axis] - away;
            inverse[axis] = 1.0f / direction[axis];
        }
    }
    LAVALIGHT_TARGET void setShear(const Real (&from)[3], const Real (&direction)[3]) {
        const Real size[] = {magnitude(direction[0]), magnitude(direction[1]), magnitude(direction[2])};
        const auto isX = (size[0] >= size[1]) & (size[0] >= size[2]);
        const auto isYUnlessX = size[1] >= size[2];
        const auto turned = [&](const Real(&v)[3], size_t i) LAVALIGHT_TARGET {
            return isX ? v[(i + 1) % 3] : isYUnlessX ? v[(i + 2) % 3] : v[i];
        };
        const Real main = turned(direction, 2);
        shear[0] = turned(direction, 0) / main;
        shear[1] = turned(direction, 1) / main;
        shear[2] = 1.0f / main;
        for (size_t i = 0; i < 3; ++i)
            origin[i] = turned(from, i);
    }
};

// Where rays are between the planes of boxes along one axis. Either the boxes or the rays are lanes.
template <typename Plane, typename Along>
LAVALIGHT_TARGET inline void clip(Plane nearPlane, Plane farPlane, Along nearOrigin, Along farOrigin,
                                  Along inverse, Floats& entry, Floats& exit) {
    entry = larger((nearPlane - nearOrigin) * inverse, entry);
    exit = smaller((farPlane - farOrigin) * inverse, exit);
}

struct Corner {
    Floats x, y, z;
};

// shearCorner() of shaders/lib/math/ray_triangle.glsl, after turning.
template <typename Place, typename Along>
LAVALIGHT_TARGET inline Corner shearCorner(Place cornerX, Place cornerY, Place cornerZ,
                                           const Along (&origin)[3], const Along (&shear)[3]) {
    const Floats x = cornerX - origin[0];
    const Floats y = cornerY - origin[1];
    const Floats z = cornerZ - origin[2];
    return {x - shear[0] * z, y - shear[1] * z, shear[2] * z};
}

LAVALIGHT_TARGET inline Floats edgeFunction(const Corner& a, const Corner& b) {
    return a.x * b.y - a.y * b.x;
}

// intersectTriangle() of shaders/lib/math/ray_triangle.glsl, to the bit: on which side of the edges rays
// pass, and where they meet the triangle's plane.
struct Edges {
    Floats a, b, c, determinant;

    LAVALIGHT_TARGET Edges(const Corner& v0, const Corner& v1, const Corner& v2)
        : a(edgeFunction(v2, v1)), b(edgeFunction(v0, v2)), c(edgeFunction(v1, v0)), determinant(a + b + c) {}

    [[nodiscard]] LAVALIGHT_TARGET Ints areAroundRay() const {
        return ((smaller(smaller(a, b), c) >= 0.0f) | (larger(larger(a, b), c) <= 0.0f)) &
               (determinant != 0.0f);
    }
};

struct Meeting {
    Floats t, b1, b2;

    LAVALIGHT_TARGET Meeting(const Edges& edges, const Corner& v0, const Corner& v1, const Corner& v2) {
        const Floats scale = 1.0f / edges.determinant;
        b1 = edges.b * scale;
        b2 = edges.c * scale;
        t = edges.a * scale * v0.z + b1 * v1.z + b2 * v2.z;
    }
};
