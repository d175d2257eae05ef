// Rays side by side: one box or triangle after the other. Included by bvh16_traversal.inl alone.

// Rays with directions of one class, which meet the same boxes and triangles at a time.
struct Packet {
    RayLanes rays;
    TriangleTaker taker;
    bool isAny;
    const Turn& turn; // of their class
    // What comes first so far.
    Ints triangles, materials; // ids are below 2^31; no triangle: -1
    Floats t, b1, b2;
    uint32_t fronts;

    LAVALIGHT_TARGET Packet(const RayLanes& lanes, bool any, TriangleTaker asked)
        : rays(lanes), taker(asked), isAny(any), turn(kTurns[lanes.classes[0]]),
          triangles(Ints{} - 1), materials{}, t{}, b1{}, b2{}, fronts(0) {}
    [[nodiscard]] LAVALIGHT_TARGET Bvh16Hit hit(uint32_t lane) const {
        return {t[lane],
                static_cast<uint32_t>(triangles[lane]),
                static_cast<uint32_t>(materials[lane]),
                {b1[lane], b2[lane]},
                (fronts >> lane & 1u) != 0};
    }
};

// Takes out of `isMet` the lanes whose rays do not take the leaf's triangle.
LAVALIGHT_TARGET inline void ask(const Packet& packet, const Bvh16Leaf& leaf, uint32_t triangle,
                                 const Meeting& meeting, uint32_t fronts, Ints& isMet) {
    const bool hasAlpha = (leaf.materials[triangle] & kAlphaBit) != 0;
    uint32_t asked = bitsOf(isMet) & (hasAlpha ? ~0u : packet.rays.culling & ~fronts);
    for (; asked != 0; asked &= asked - 1) {
        const auto lane = static_cast<uint32_t>(std::countr_zero(asked));
        const Bvh16Hit hit{meeting.t[lane],
                           leaf.triangles[triangle],
                           leaf.materials[triangle],
                           {meeting.b1[lane], meeting.b2[lane]},
                           (fronts >> lane & 1u) != 0};
        if (!packet.taker.takes(packet.taker.taker, packet.rays.rays[lane], hit))
            isMet[lane] = 0;
    }
}

LAVALIGHT_TARGET inline void visit(const Bvh16Leaf& leaf, Packet& packet) {
    RayLanes& rays = packet.rays;
    for (uint32_t i = 0; i < leaf.count; ++i) {
        const auto sheared = [&](const std::array<Bvh16Leaf::Floats, 3>& corner) LAVALIGHT_TARGET {
            return shearCorner(corner[packet.turn.axes[0]][i], corner[packet.turn.axes[1]][i],
                               corner[packet.turn.axes[2]][i], rays.origin, rays.shear);
        };
        const Corner v0 = sheared(leaf.corners[0]);
        const Corner v1 = sheared(leaf.corners[1]);
        const Corner v2 = sheared(leaf.corners[2]);
        const Edges edges(v0, v1, v2);
        Ints isMet = edges.areAroundRay();
        if (bitsOf(isMet) == 0)
            continue;
        const Meeting meeting(edges, v0, v1, v2);
        const auto triangle = static_cast<int32_t>(leaf.triangles[i]);
        const Ints comesFirst =
            (meeting.t < rays.end) | ((meeting.t == rays.end) & (triangle < packet.triangles));
        isMet &= (meeting.t > 0.0f) & comesFirst & (triangle != rays.firstIgnored) &
                 (triangle != rays.secondIgnored);
        if (bitsOf(isMet) == 0)
            continue;
        const uint32_t fronts = bitsOf((edges.determinant > 0.0f) == (rays.shear[2] > 0.0f));
        if ((leaf.materials[i] & kAlphaBit) != 0 || (rays.culling & ~fronts) != 0)
            ask(packet, leaf, i, meeting, fronts, isMet);
        const uint32_t met = bitsOf(isMet);
        packet.fronts = (packet.fronts & ~met) | (fronts & met);
        packet.triangles = isMet ? Ints{} + triangle : packet.triangles;
        packet.materials = isMet ? Ints{} + static_cast<int32_t>(leaf.materials[i]) : packet.materials;
        packet.t = isMet ? meeting.t : packet.t;
        packet.b1 = isMet ? meeting.b1 : packet.b1;
        packet.b2 = isMet ? meeting.b2 : packet.b2;
        rays.end = isMet ? (packet.isAny ? Floats{} - 1.0f : meeting.t) : rays.end;
    }
}

// A child that waits, and where each ray enters its box; NaN where it does not, which is before no end.
struct WaitingChild {
    Floats entry;
    uint32_t child;
};

// Puts the children whose boxes rays enter on a stack, and returns their number. On top is the child with the
// smallest entry, taken from the lowest lane that enters each; or the largest child, where any triangle ends
// a ray.
LAVALIGHT_TARGET inline uint32_t enter(const Bvh16Node& node, const Packet& packet, WaitingChild* stack) {
    const Floats end = packet.rays.end * kMargin;
    std::array<Floats, kBvh16Width> entries;
    std::array<uint64_t, kBvh16Width> order; // in falling order
    uint32_t count = 0;
    for (uint32_t child = 0; child < kBvh16Width; ++child) {
        if (node.planes[0][child] > node.planes[3][child])
            break; // this one and all after it are missing
        Floats entry = {};
        Floats exit = end;
        for (size_t axis = 0; axis < 3; ++axis)
            clip(node.planes[packet.turn.nearPlanes[axis]][child],
                 node.planes[packet.turn.farPlanes[axis]][child], packet.rays.nearOrigin[axis],
                 packet.rays.farOrigin[axis], packet.rays.inverse[axis], entry, exit);
        const Ints isEntered = entry <= exit;
        const uint32_t lanes = bitsOf(isEntered);
        if (lanes == 0)
            continue;
        entries[child] = isEntered ? entry : Floats{} + std::numeric_limits<float>::quiet_NaN();
        const float first = entries[child][std::countr_zero(lanes)];
        const uint64_t key = uint64_t{packet.isAny ? 0 : std::bit_cast<uint32_t>(first)} << 32 | child;
        uint32_t place = count++;
        for (; place > 0 && order[place - 1] < key; --place)
            order[place] = order[place - 1];
        order[place] = key;
    }
    for (uint32_t i = 0; i < count; ++i) {
        const auto child = static_cast<uint32_t>(order[i]);
        stack[i] = {entries[child], node.children[child]};
    }
    return count;
}

LAVALIGHT_TARGET inline void traverse(const Bvh16& bvh, Packet& packet) {
    std::array<WaitingChild, kMostWaiting> stack;
    uint32_t size = enter(bvh.nodes[0], packet, stack.data());
    while (size > 0) {
        const WaitingChild& last = stack[--size];
        const uint32_t child = last.child;
        if (bitsOf(last.entry <= packet.rays.end * kMargin) == 0)
            continue;
        if ((child & kBvh16LeafBit) != 0)
            visit(bvh.leaves[child & ~kBvh16LeafBit], packet);
        else
            size += enter(bvh.nodes[child], packet, &stack[size]);
    }
}
