// The traversal of a Bvh16, for vectors of LANES floats and the processors that LAVALIGHT_TARGET names:
// included once for each, within a namespace.

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

LAVALIGHT_TARGET inline Floats larger(Floats a, Floats b) {
    return a > b ? a : b;
}

LAVALIGHT_TARGET inline Floats smaller(Floats a, Floats b) {
    return a < b ? a : b;
}

// Lanes as bits, and where the ray meets them.
struct MetBoxes {
    uint32_t lanes;
    alignas(64) std::array<float, kBvh16Width> t;

    uint32_t takeLane() {
        const auto lane = static_cast<uint32_t>(std::countr_zero(lanes));
        lanes &= lanes - 1;
        return lane;
    }
};

struct MetTriangles {
    uint32_t lanes, fronts;
    alignas(64) std::array<float, kBvh16LeafWidth> t, b1, b2;

    // Returns the lane with the smallest t, and removes it.
    uint32_t next() {
        auto nearest = static_cast<uint32_t>(std::countr_zero(lanes));
        for (uint32_t rest = lanes & (lanes - 1); rest != 0; rest &= rest - 1) {
            const auto lane = static_cast<uint32_t>(std::countr_zero(rest));
            nearest = t[lane] < t[nearest] ? lane : nearest;
        }
        lanes &= ~(1u << nearest);
        return nearest;
    }
};

LAVALIGHT_TARGET inline void meetBoxes(const SlabRay& ray, const Bvh16Node& node, float end, MetBoxes& met) {
    met.lanes = 0;
    for (uint32_t part = 0; part < kBvh16Width / LANES; ++part) {
        Floats entry = {};
        Floats exit = Floats{} + end;
        for (size_t axis = 0; axis < 3; ++axis) {
            entry = larger((load(node.planes[ray.nearPlanes[axis]], part) - ray.nearOrigin[axis]) *
                               ray.inverse[axis],
                           entry);
            exit = smaller((load(node.planes[ray.farPlanes[axis]], part) - ray.farOrigin[axis]) *
                               ray.inverse[axis],
                           exit);
        }
        met.lanes |= bitsOf(entry <= exit) << (part * LANES);
        store(met.t, part, entry);
    }
}

// shearCorner() of shaders/lib/math/ray_triangle.glsl
struct Corner {
    Floats x, y, z;
};

LAVALIGHT_TARGET inline Corner shearCorner(const LeafRay& ray, const std::array<Bvh16Leaf::Floats, 3>& corner,
                                           uint32_t part) {
    const Floats x = load(corner[ray.axes[0]], part) - ray.origin[0];
    const Floats y = load(corner[ray.axes[1]], part) - ray.origin[1];
    const Floats z = load(corner[ray.axes[2]], part) - ray.origin[2];
    return {x - ray.shear[0] * z, y - ray.shear[1] * z, ray.shear[2] * z};
}

LAVALIGHT_TARGET inline Floats edgeFunction(const Corner& a, const Corner& b) {
    return a.x * b.y - a.y * b.x;
}

// intersectTriangle() of the same, to the bit.
LAVALIGHT_TARGET inline void meetTriangles(const LeafRay& ray, const Bvh16Leaf& leaf, float end,
                                           MetTriangles& met) {
    met.lanes = met.fronts = 0;
    for (uint32_t part = 0; part < kBvh16LeafWidth / LANES; ++part) {
        const Corner a = shearCorner(ray, leaf.corners[0], part);
        const Corner b = shearCorner(ray, leaf.corners[1], part);
        const Corner c = shearCorner(ray, leaf.corners[2], part);
        const Floats edges[] = {edgeFunction(c, b), edgeFunction(a, c), edgeFunction(b, a)};
        const Floats determinant = edges[0] + edges[1] + edges[2];
        const Ints isInside = ((smaller(smaller(edges[0], edges[1]), edges[2]) >= 0.0f) |
                               (larger(larger(edges[0], edges[1]), edges[2]) <= 0.0f)) &
                              (determinant != 0.0f);
        if (bitsOf(isInside) == 0)
            continue;
        const Floats scale = 1.0f / determinant;
        const Floats b1 = edges[1] * scale;
        const Floats b2 = edges[2] * scale;
        const Floats t = edges[0] * scale * a.z + b1 * b.z + b2 * c.z;
        const Ints triangles = load(leaf.triangles, part);
        const Ints isMet = isInside & (t > 0.0f) & (t <= end) & (triangles != ray.firstIgnored) &
                           (triangles != ray.secondIgnored);
        met.lanes |= bitsOf(isMet) << (part * LANES);
        met.fronts |= bitsOf(determinant > 0.0f) << (part * LANES);
        store(met.t, part, t);
        store(met.b1, part, b1);
        store(met.b2, part, b2);
    }
    met.fronts = ray.shear[2] > 0.0f ? met.fronts : ~met.fronts;
}

LAVALIGHT_TARGET inline void visit(const Bvh16Leaf& leaf, const LeafRay& ray, MetTriangles& met,
                                   Search& search) {
    meetTriangles(ray, leaf, search.end, met);
    while (met.lanes != 0) {
        const uint32_t lane = met.next();
        if (met.t[lane] > search.end)
            return;
        search.meet(
            {met.t[lane], leaf.triangles[lane], {met.b1[lane], met.b2[lane]}, (met.fronts >> lane & 1u) != 0},
            leaf.materials[lane]);
        if (search.isOver())
            return;
    }
}

// Children that wait, each behind the bits of the t where its box is entered: floats that are not negative
// are ordered as their bits are.
struct Stack {
    std::array<uint64_t, kMaxBvh16Levels*(kBvh16Width - 1) + 1> children;
    uint32_t size = 0;

    LAVALIGHT_TARGET static uint64_t waiting(const Bvh16Node& node, const MetBoxes& boxes, uint32_t lane) {
        return uint64_t{std::bit_cast<uint32_t>(boxes.t[lane])} << 32 | node.children[lane];
    }
    // Removes children from the top until one's box is entered at `end` or before; false: none is left.
    LAVALIGHT_TARGET bool pop(float end, uint32_t& child) {
        while (size > 0) {
            const uint64_t last = children[--size];
            child = static_cast<uint32_t>(last);
            if (std::bit_cast<float>(static_cast<uint32_t>(last >> 32)) <= end)
                return true;
        }
        return false;
    }
};

// Returns the nearest of the children that are met, at least one. The others wait, the nearest on top.
LAVALIGHT_TARGET inline uint32_t takeNearest(const Bvh16Node& node, MetBoxes& met, Stack& stack) {
    uint64_t nearest = Stack::waiting(node, met, met.takeLane());
    const uint32_t siblings = stack.size;
    while (met.lanes != 0) {
        const uint64_t other = Stack::waiting(node, met, met.takeLane());
        const uint64_t farther = std::max(nearest, other);
        nearest = std::min(nearest, other);
        uint32_t place = stack.size++;
        for (; place > siblings && stack.children[place - 1] < farther; --place)
            stack.children[place] = stack.children[place - 1];
        stack.children[place] = farther;
    }
    return static_cast<uint32_t>(nearest);
}

// Returns the largest of the children that are met, at least one. The others wait, the largest on top.
LAVALIGHT_TARGET inline uint32_t takeLargest(const Bvh16Node& node, MetBoxes& met, Stack& stack) {
    const uint32_t largest = met.takeLane();
    for (; met.lanes != 0; met.lanes &= ~std::bit_floor(met.lanes))
        stack.children[stack.size++] =
            Stack::waiting(node, met, static_cast<uint32_t>(std::bit_width(met.lanes)) - 1);
    return node.children[largest];
}

LAVALIGHT_TARGET void traverseTree(const Bvh16& bvh, const SlabRay& slab, const LeafRay& ray,
                                   Search& search) {
    Stack stack;
    MetBoxes boxes;
    MetTriangles triangles;
    uint32_t child = 0;
    do {
        while ((child & kBvh16LeafBit) == 0) {
            const Bvh16Node& node = bvh.nodes[child];
            meetBoxes(slab, node, withMargin(search.end), boxes);
            if (boxes.lanes != 0)
                child = search.isAny ? takeLargest(node, boxes, stack) : takeNearest(node, boxes, stack);
            else if (!stack.pop(withMargin(search.end), child))
                return;
        }
        visit(bvh.leaves[child & ~kBvh16LeafBit], ray, triangles, search);
    } while (!search.isOver() && stack.pop(withMargin(search.end), child));
}
