// How a render is cut into parts, and what the scripts say of them.
#include <algorithm>

#include <gtest/gtest.h>

#include "base/error.h"
#include "split/split_scripts.h"

namespace lavalight {
namespace {

SplitPlan planOf(uint32_t parts, SampleRange samples) {
    SplitPlan plan;
    plan.scene = "scene-0123.glb";
    plan.words = {"--size", "64x64", "--camera", "over the 'shoulder'"};
    plan.parts = parts;
    plan.samples = samples;
    plan.folder = "out/job";
    return plan;
}

std::string scriptOf(const SplitPlan& plan, const std::string& name) {
    const std::vector<SplitScript> scripts = scriptsOf(plan);
    const auto found = std::find_if(scripts.begin(), scripts.end(),
                                    [&](const SplitScript& script) { return script.name == name; });
    return found == scripts.end() ? std::string() : found->text;
}

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

TEST(SplitPlan, PartsShareAllSamplesWithoutGapOrOverlap) {
    for (const uint32_t count : {1u, 3u, 7u, 64u})
        for (const SampleRange samples :
             {SampleRange{0, 64}, SampleRange{5, 105}, SampleRange{0x7fffff00, 0x7fffffff}}) {
            uint32_t next = samples.first;
            for (const SplitPart& part : partsOf(planOf(count, samples))) {
                ASSERT_EQ(part.words.front(), "--samples");
                const auto ranges = parseSampleRanges(part.words.at(1));
                ASSERT_TRUE(ranges) << part.words.at(1);
                EXPECT_EQ(ranges->front().first, next);
                next = ranges->front().end;
            }
            EXPECT_EQ(next, samples.end) << count;
        }
}

TEST(SplitPlan, PartsAreOfNearlyOneLength) {
    uint32_t least = 100;
    uint32_t most = 0;
    for (const SplitPart& part : partsOf(planOf(7, {0, 64}))) {
        const uint32_t count = countOf(parseSampleRanges(part.words.at(1)).value());
        least = std::min(least, count);
        most = std::max(most, count);
    }
    EXPECT_LE(most - least, 1u);
}

TEST(SplitPlan, FramesAreASecondAxis) {
    SplitPlan plan = planOf(2, {0, 8});
    plan.frames = SplitFrames{7, 9};
    const std::vector<SplitPart> parts = partsOf(plan);
    ASSERT_EQ(parts.size(), 4u);
    EXPECT_EQ(parts[1].name, "frame-0007-part-0001");
    EXPECT_EQ(parts[2].words, (std::vector<std::string>{"--frame", "8", "--samples", "0:4"}));
    const std::string merge = scriptOf(plan, "merge.sh");
    EXPECT_TRUE(has(
        merge,
        "-o merged_0007.exr \\\n    parts/frame-0007-part-0000.exr \\\n    parts/frame-0007-part-0001.exr\n"))
        << merge;
    EXPECT_TRUE(has(merge, "-o merged_0008.exr"));
}

TEST(SplitPlan, WhatCannotBeSplitIsRefused) {
    EXPECT_THROW(requirePossible(planOf(0, {0, 64})), UsageError);
    EXPECT_THROW(requirePossible(planOf(65, {0, 64})), UsageError);
    EXPECT_NO_THROW(requirePossible(planOf(64, {0, 64})));
    SplitPlan matrix = planOf(129, {0, 1024});
    matrix.frames = SplitFrames{0, 2};
    EXPECT_NO_THROW(requirePossible(matrix));
    matrix.engine = SplitEngine::github;
    EXPECT_THROW(requirePossible(matrix), UsageError);
}

TEST(SplitScripts, EachPartHasALine) {
    EXPECT_EQ(scriptOf(planOf(2, {0, 9}), "parts.txt"), "part-0000 --samples 0:4\npart-0001 --samples 4:9\n");
}

TEST(SplitScripts, NoMarkIsLeftInAnyScript) {
    for (const SplitEngine engine : {SplitEngine::shell, SplitEngine::slurm, SplitEngine::github}) {
        SplitPlan plan = planOf(3, {0, 64});
        plan.engine = engine;
        plan.hasPng = true;
        for (const SplitScript& script : scriptsOf(plan)) {
            for (const char* mark : {"@program@", "@scene@", "@options@", "@interval@", "@last@", "@merges@",
                                     "@previews@", "@merge_options@", "@constraint@", "@threads@",
                                     "@version@", "@folder@", "@folder_word@", "@numbers@"})
                EXPECT_FALSE(has(script.text, mark)) << script.name << " has " << mark;
        }
    }
}

TEST(SplitScripts, ValuesThatLookLikeMarksStayAsTheyAre) {
    SplitPlan plan = planOf(2, {0, 64});
    plan.words = {"--camera", "@scene@"};
    EXPECT_TRUE(has(scriptOf(plan, "part.sh"), "--camera @scene@"));
}

TEST(SplitScripts, WordsReachTheShellAsTheyAre) {
    EXPECT_EQ(shellQuoted("64x64"), "64x64");
    EXPECT_EQ(shellQuoted("a b"), "'a b'");
    EXPECT_EQ(shellQuoted("it's $HOME"), "'it'\\''s $HOME'");
    EXPECT_EQ(shellQuoted(""), "''");
    EXPECT_TRUE(has(scriptOf(planOf(2, {0, 64}), "part.sh"), "--camera 'over the '\\''shoulder'\\'''"));
}

TEST(SplitScripts, SlurmIsAskedForOneTaskAPartAndForTheNodesOfOneKind) {
    SplitPlan plan = planOf(8, {0, 64});
    plan.engine = SplitEngine::slurm;
    EXPECT_TRUE(has(scriptOf(plan, "render.sbatch"), "#SBATCH --array=0-7\n"));
    EXPECT_FALSE(has(scriptOf(plan, "render.sbatch"), "--constraint"));
    EXPECT_FALSE(has(scriptOf(plan, "render.sbatch"), "\n\n")) << "an empty line in place of the constraint";
    EXPECT_TRUE(has(scriptOf(plan, "render.sbatch"), "SLURM_CPUS_PER_TASK"));
    plan.constraint = "icelake";
    plan.hasThreads = true;
    EXPECT_TRUE(has(scriptOf(plan, "render.sbatch"), "#SBATCH --constraint=icelake\n"));
    EXPECT_TRUE(has(scriptOf(plan, "merge.sbatch"), "#SBATCH --constraint=icelake\n"));
    EXPECT_FALSE(has(scriptOf(plan, "render.sbatch"), "SLURM_CPUS_PER_TASK"));
    EXPECT_TRUE(scriptOf(plan, "run.sh").empty());
}

TEST(SplitScripts, TheMatrixHasANumberForEachPart) {
    SplitPlan plan = planOf(4, {0, 64});
    plan.engine = SplitEngine::github;
    const std::string workflow = scriptOf(plan, "workflow.yml");
    EXPECT_TRUE(has(workflow, "number: [0, 1, 2, 3]")) << workflow;
    EXPECT_TRUE(has(workflow, "  out/job/part.sh ${{ matrix.number }}"));
}

TEST(SplitScripts, KindsOfMachineAreMixedOnlyWhenAsked) {
    SplitPlan plan = planOf(2, {0, 64});
    EXPECT_FALSE(has(scriptOf(plan, "merge.sh"), "--statistical"));
    plan.isStatistical = true;
    EXPECT_TRUE(has(scriptOf(plan, "merge.sh"), "merge --statistical -o merged.exr"));
    EXPECT_TRUE(has(scriptOf(plan, "preview.sh"), "merge --statistical "));
}

} // namespace
} // namespace lavalight
