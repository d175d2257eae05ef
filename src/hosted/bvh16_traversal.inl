// The traversal of a Bvh16, for vectors of LANES floats and the processors that LAVALIGHT_TARGET names:
// included once for each, within a namespace.
#include "hosted/bvh16_lanes.inl"
#include "hosted/bvh16_lone_ray.inl"

// Rays side by side. Lanes without a ray, or whose ray is over, have an end below 0 and meet nothing.
struct RayLanes : RaySetup<Floats> {
    std::array<uint32_t, LANES> rays{};    // their numbers
    std::array<uint32_t, LANES> classes{}; // of their directions
    Floats end;                            // as Search::end
    Ints firstIgnored, secondIgnored;
    uint32_t culling; // lanes that cull back faces

    [[nodiscard]] LAVALIGHT_TARGET LoneRay alone(uint32_t lane) const {
        LoneRay ray;
        for (size_t i = 0; i < 3; ++i) {
            ray.nearOrigin[i] = nearOrigin[i][lane];
            ray.farOrigin[i] = farOrigin[i][lane];
            ray.inverse[i] = inverse[i][lane];
            ray.origin[i] = origin[i][lane];
            ray.shear[i] = shear[i][lane];
        }
        ray.turn = &kTurns[classes[lane]];
        ray.firstIgnored = firstIgnored[lane];
        ray.secondIgnored = secondIgnored[lane];
        return ray;
    }
    [[nodiscard]] Search search(uint32_t lane, bool isAny, TriangleTaker taker) const {
        return {taker, rays[lane], (culling >> lane & 1u) != 0, isAny, end[lane]};
    }
};

// The rays with these numbers, at most LANES.
LAVALIGHT_TARGET inline RayLanes gather(const Bvh16& bvh, std::span<const Bvh16Ray> rays,
                                        std::span<const uint32_t> numbers) {
    RayLanes lanes;
    Floats origin[3] = {};
    Floats direction[3] = {};
    lanes.end = Floats{} - 1.0f;
    lanes.firstIgnored = lanes.secondIgnored = Ints{};
    lanes.culling = 0;
    for (size_t lane = 0; lane < numbers.size(); ++lane) {
        const Bvh16Ray& ray = rays[numbers[lane]];
        for (int axis = 0; axis < 3; ++axis) {
            origin[axis][lane] = ray.origin[axis];
            direction[axis][lane] = ray.direction[axis];
        }
        lanes.rays[lane] = numbers[lane];
        lanes.classes[lane] = directionClass(ray.direction);
        lanes.end[lane] = ray.end;
        lanes.firstIgnored[lane] = static_cast<int32_t>(ray.firstIgnored);
        lanes.secondIgnored[lane] = static_cast<int32_t>(ray.secondIgnored);
        lanes.culling |= (ray.cullsBackFaces ? 1u : 0u) << lane;
    }
    Floats sum = {};
    for (size_t axis = 0; axis < 3; ++axis)
        sum += origin[axis] + direction[axis];
    const Ints isFinite = sum - sum == 0.0f;
    lanes.end = isFinite ? lanes.end : Floats{} - 1.0f;
    lanes.set(origin, direction, bvh.bounds);
    return lanes;
}

#include "hosted/bvh16_packet.inl"

// Finds what rays of any directions meet, at most LANES: one after the other.
LAVALIGHT_TARGET void findOneByOne(const Bvh16Query& query, std::span<const uint32_t> numbers) {
    const RayLanes lanes = gather(query.bvh, query.rays, numbers);
    for (uint32_t lane = 0; lane < numbers.size(); ++lane) {
        Search search = lanes.search(lane, query.sought == Sought::any, query.taker);
        if (search.end >= 0.0f)
            traverse(query.bvh, lanes.alone(lane), search);
        query.hits[numbers[lane]] = search.first;
    }
}

// Finds what rays of one class of directions meet, at most LANES: all at a time.
LAVALIGHT_TARGET void findTogether(const Bvh16Query& query, std::span<const uint32_t> numbers) {
    Packet packet(gather(query.bvh, query.rays, numbers), query.sought == Sought::any, query.taker);
    traverse(query.bvh, packet);
    for (uint32_t lane = 0; lane < numbers.size(); ++lane)
        query.hits[numbers[lane]] = packet.hit(lane);
}

// Finds what a ray that is alone meets.
LAVALIGHT_TARGET void findOne(const Bvh16Query& query) {
    const Bvh16Ray& ray = query.rays[0];
    const float origin[] = {ray.origin.x, ray.origin.y, ray.origin.z};
    float direction[] = {ray.direction.x, ray.direction.y, ray.direction.z};
    const glm::vec3 sum = ray.origin + ray.direction;
    Search search{query.taker, 0, ray.cullsBackFaces, query.sought == Sought::any, ray.end};
    if (std::isfinite(sum.x + sum.y + sum.z)) {
        LoneRay lone;
        lone.set(origin, direction, query.bvh.bounds);
        lone.turn = &kTurns[directionClass(ray.direction)];
        lone.firstIgnored = static_cast<int32_t>(ray.firstIgnored);
        lone.secondIgnored = static_cast<int32_t>(ray.secondIgnored);
        traverse(query.bvh, lone, search);
    }
    query.hits[0] = search.first;
}

LAVALIGHT_TARGET void find(const Bvh16Query& query) {
    if (query.rays.size() == 1) {
        findOne(query);
        return;
    }
    const bool together = query.likeness == Likeness::alike || query.bvh.nodes.size() <= kMostNodesOfPackets;
    for (size_t first = 0; first < query.rays.size(); first += kRaysAtATime) {
        const size_t count = std::min(kRaysAtATime, query.rays.size() - first);
        const RayOrder order(query.rays.subspan(first, count), first, together);
        for (size_t start = 0; start < count;) {
            const size_t end = std::min<size_t>(start + LANES, order.endOfClass(start));
            const auto numbers = order.numbers(start, end);
            together ? findTogether(query, numbers) : findOneByOne(query, numbers);
            start = end;
        }
    }
}
