// A ray by itself: boxes of a node, or triangles of a leaf, side by side. Included by bvh16_traversal.inl
// alone.

// A ray that boxes and triangles are tested with side by side.
struct LoneRay : RaySetup<float> {
    const Turn* turn;
    int32_t firstIgnored, secondIgnored;
};

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

LAVALIGHT_TARGET inline void meetBoxes(const LoneRay& ray, const Bvh16Node& node, float end, MetBoxes& met) {
    met.lanes = 0;
    for (uint32_t part = 0; part < kBvh16Width / LANES; ++part) {
        Floats entry = {};
        Floats exit = Floats{} + end;
        for (size_t axis = 0; axis < 3; ++axis)
            clip(load(node.planes[ray.turn->nearPlanes[axis]], part),
                 load(node.planes[ray.turn->farPlanes[axis]], part), ray.nearOrigin[axis],
                 ray.farOrigin[axis], ray.inverse[axis], entry, exit);
        met.lanes |= bitsOf(entry <= exit) << (part * LANES);
        store(met.t, part, entry);
    }
}

LAVALIGHT_TARGET inline void meetTriangles(const LoneRay& ray, const Bvh16Leaf& leaf, float end,
                                           MetTriangles& met) {
    met.lanes = met.fronts = 0;
    for (uint32_t part = 0; part < kBvh16LeafWidth / LANES; ++part) {
        const auto sheared = [&](const std::array<Bvh16Leaf::Floats, 3>& corner) LAVALIGHT_TARGET {
            return shearCorner(load(corner[ray.turn->axes[0]], part), load(corner[ray.turn->axes[1]], part),
                               load(corner[ray.turn->axes[2]], part), ray.origin, ray.shear);
        };
        const Corner v0 = sheared(leaf.corners[0]);
        const Corner v1 = sheared(leaf.corners[1]);
        const Corner v2 = sheared(leaf.corners[2]);
        const Edges edges(v0, v1, v2);
        const Ints isInside = edges.areAroundRay();
        if (bitsOf(isInside) == 0)
            continue;
        const Meeting meeting(edges, v0, v1, v2);
        const Ints triangles = load(leaf.triangles, part);
        const Ints isMet = isInside & (meeting.t > 0.0f) & (meeting.t <= end) &
                           (triangles != ray.firstIgnored) & (triangles != ray.secondIgnored);
        met.lanes |= bitsOf(isMet) << (part * LANES);
        met.fronts |= bitsOf(edges.determinant > 0.0f) << (part * LANES);
        store(met.t, part, meeting.t);
        store(met.b1, part, meeting.b1);
        store(met.b2, part, meeting.b2);
    }
    met.fronts = ray.shear[2] > 0.0f ? met.fronts : ~met.fronts;
}

LAVALIGHT_TARGET inline void visit(const Bvh16Leaf& leaf, const LoneRay& ray, MetTriangles& met,
                                   Search& search) {
    meetTriangles(ray, leaf, search.end, met);
    while (met.lanes != 0) {
        const uint32_t lane = met.next();
        if (met.t[lane] > search.end)
            return;
        search.meet({met.t[lane],
                     leaf.triangles[lane],
                     leaf.materials[lane],
                     {met.b1[lane], met.b2[lane]},
                     (met.fronts >> lane & 1u) != 0});
        if (search.isOver())
            return;
    }
}

// Children that wait, each behind the bits of the t where its box is entered: floats that are not negative
// are ordered as their bits are.
struct Stack {
    std::array<uint64_t, kMostWaiting> children;
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

LAVALIGHT_TARGET inline void traverse(const Bvh16& bvh, const LoneRay& ray, Search& search) {
    Stack stack;
    MetBoxes boxes;
    MetTriangles triangles;
    uint32_t child = 0;
    do {
        while ((child & kBvh16LeafBit) == 0) {
            const Bvh16Node& node = bvh.nodes[child];
            meetBoxes(ray, node, search.end * kMargin, boxes);
            if (boxes.lanes != 0)
                child = search.isAny ? takeLargest(node, boxes, stack) : takeNearest(node, boxes, stack);
            else if (!stack.pop(search.end * kMargin, child))
                return;
        }
        visit(bvh.leaves[child & ~kBvh16LeafBit], ray, triangles, search);
    } while (!search.isOver() && stack.pop(search.end * kMargin, child));
}
