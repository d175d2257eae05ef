// The film's sums are exact: bit for bit those of 128-bit integers, from rounding up to saturation.
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "shared/film.h"
#include "support/random_numbers.h"
#include "support/run_kernel.h"
#include "support/test_device.h"
#include "test_kernels.h"

namespace lavalight::test {
namespace {

__extension__ using Wide = unsigned __int128;
__extension__ using WideSigned = __int128;

constexpr size_t kRun = 16; // as in the kernel

struct alignas(16) Answer { // as in the kernel
    std::array<uint32_t, 4> four;
    std::array<uint32_t, 3> three;
    uint32_t leftThree;
    uint32_t leftFour;
    float value; // what the sum of three words stands for
    float signedValue;
    uint32_t leftSigned; // how many values were limited
    std::array<uint32_t, 4> signedFour;
};

// A sum of `words` 32-bit words, its lowest bit worth 2^lowestExponent.
class ExactSum {
  public:
    ExactSum(uint32_t words, int lowestExponent)
        : largest_(~Wide{0} >> (128 - 32 * words)), lowestExponent_(lowestExponent) {}

    void add(float x) {
        int exponent = 0;
        const auto mantissa = static_cast<uint64_t>(std::ldexp(std::frexp(x, &exponent), 24)); // exact
        const int shift = exponent - 24 - lowestExponent_;
        Wide units = 0;
        bool fits = true;
        if (mantissa != 0 && shift >= 0) {
            fits = shift < 128 && (largest_ >> shift) >= mantissa;
            units = fits ? Wide{mantissa} << shift : 0;
        } else if (mantissa != 0 && shift > -64) {
            units = (mantissa + (uint64_t{1} << (-shift - 1))) >> -shift; // to nearest, halves up
        }
        if (fits && units <= largest_ - value_) {
            value_ += units;
        } else {
            value_ = largest_;
            ++left_;
        }
    }
    [[nodiscard]] uint32_t word(size_t i) const { return static_cast<uint32_t>(value_ >> (32 * i)); }
    [[nodiscard]] uint32_t left() const { return left_; }
    [[nodiscard]] double value() const { return std::ldexp(static_cast<double>(value_), lowestExponent_); }

  private:
    Wide value_ = 0;
    Wide largest_;
    int lowestExponent_;
    uint32_t left_ = 0;
};

// A sum of four words in two's complement, its lowest bit worth 2^kSumLowestExponent.
class ExactSignedSum {
  public:
    void add(float x) {
        const bool fits = std::abs(x) <= kMostSigned; // NaN does not
        const double kept = std::fmin(std::abs(double{x}), kMostSigned);
        // A float times a power of two is exact, and below 2^96 here.
        const double units = std::floor(std::ldexp(kept, -kSumLowestExponent) + 0.5);
        const auto whole = static_cast<WideSigned>(units);
        value_ += x < 0.0f ? -whole : whole;
        left_ += fits ? 0 : 1;
    }
    [[nodiscard]] uint32_t word(size_t i) const {
        return static_cast<uint32_t>(static_cast<Wide>(value_) >> (32 * i));
    }
    [[nodiscard]] uint32_t left() const { return left_; }
    [[nodiscard]] double value() const { return std::ldexp(static_cast<double>(value_), kSumLowestExponent); }

  private:
    WideSigned value_ = 0;
    uint32_t left_ = 0;
};

class FixedPointTest : public DeviceTest {
  protected:
    [[nodiscard]] std::vector<Answer> answersTo(const std::vector<float>& values) {
        KernelRunner runner(device(), test_kernels::find("fixed_point_test"));
        return runner.run<Answer>(std::span<const float>(values), values.size() / kRun);
    }
    // Each run of kRun values is one sum. They may be negative.
    void expectSignedExact(const std::vector<float>& values) {
        ASSERT_EQ(values.size() % kRun, 0u);
        const std::vector<Answer> answers = answersTo(values);
        for (size_t i = 0; i < answers.size(); ++i) {
            ExactSignedSum sum;
            for (const float x : std::span(values).subspan(i * kRun, kRun))
                sum.add(x);
            for (size_t word = 0; word < 4; ++word)
                ASSERT_EQ(answers[i].signedFour[word], sum.word(word)) << "sum " << i << " word " << word;
            ASSERT_NEAR(answers[i].signedValue, sum.value(), 0x1p-22 * std::abs(sum.value())) << "sum " << i;
            ASSERT_EQ(answers[i].leftSigned, sum.left()) << "sum " << i;
        }
    }
    // They must not be negative.
    void expectExact(const std::vector<float>& values) {
        ASSERT_EQ(values.size() % kRun, 0u);
        const std::vector<Answer> answers = answersTo(values);
        for (size_t i = 0; i < answers.size(); ++i) {
            ExactSum three(3, kSumLowestExponent);
            ExactSum four(4, kSquareLowestExponent);
            for (const float x : std::span(values).subspan(i * kRun, kRun)) {
                three.add(x);
                four.add(x);
            }
            for (size_t word = 0; word < 3; ++word)
                ASSERT_EQ(answers[i].three[word], three.word(word)) << "sum " << i << " word " << word;
            for (size_t word = 0; word < 4; ++word)
                ASSERT_EQ(answers[i].four[word], four.word(word)) << "sum " << i << " word " << word;
            ASSERT_NEAR(answers[i].value, three.value(), 0x1p-22 * three.value()) << "sum " << i;
            ASSERT_EQ(answers[i].leftThree, three.left());
            ASSERT_EQ(answers[i].leftFour, four.left());
        }
    }
};

std::vector<float> randomValues(float lowest, float highest, size_t count) {
    Random random(1);
    std::vector<float> values(count);
    for (float& x : values)
        x = std::pow(10.0f, random.between(lowest, highest));
    return values;
}

TEST_F(FixedPointTest, SumsOfRadianceAreExact) {
    expectExact(randomValues(-8.0f, 8.0f, 4096 * kRun));
}

TEST_F(FixedPointTest, SumsOverTheWholeRangeOfFloatsAreExactOrSaturate) {
    expectExact(randomValues(-30.0f, 30.0f, 4096 * kRun));
}

// Values around the smallest unit, the largest sum and the borders of words.
TEST_F(FixedPointTest, BordersAreExact) {
    std::vector<float> values = {0.0f, std::numeric_limits<float>::denorm_min(),
                                 std::numeric_limits<float>::min(), std::numeric_limits<float>::max()};
    for (int exponent = -90; exponent < 90; ++exponent)
        for (const float factor : {1.0f, 1.0f - 0x1p-24f, 1.0f + 0x1p-23f, 1.5f})
            values.push_back(std::ldexp(factor, exponent));
    std::vector<float> alone; // each value in a sum of its own, then added to itself
    std::vector<float> repeated;
    for (const float x : values) {
        alone.push_back(x);
        alone.insert(alone.end(), kRun - 1, 0.0f);
        repeated.insert(repeated.end(), kRun, x);
    }
    expectExact(alone);
    expectExact(repeated);
}

// Fills words with ones, then adds the smallest unit: the carry runs through all of them.
TEST_F(FixedPointTest, CarriesRunThroughFullWords) {
    for (const int lowest : {kSumLowestExponent, kSquareLowestExponent}) {
        const auto ones = [&](int first, int end) { // bits [first, end) above the lowest
            return std::ldexp(1.0f, lowest + end) - std::ldexp(1.0f, lowest + first);
        };
        std::vector<float> values = {ones(40, 64), ones(16, 40), ones(0, 16), std::ldexp(1.0f, lowest)};
        values.resize(kRun, 0.0f);
        expectExact(values);
    }
}

std::vector<float> withRandomSigns(std::vector<float> values) {
    Random random(2);
    for (float& x : values)
        x = random.unit() < 0.5f ? -x : x;
    return values;
}

TEST_F(FixedPointTest, SignedSumsAreExactOnBothSidesOfZero) {
    expectSignedExact(withRandomSigns(randomValues(-8.0f, 8.0f, 4096 * kRun)));
}

TEST_F(FixedPointTest, SignedSumsLimitWhatIsBeyondTheirRangeAtBothEnds) {
    expectSignedExact(withRandomSigns(randomValues(-30.0f, 30.0f, 4096 * kRun)));
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    const std::vector<float> most(kRun, kMostSigned);
    const std::vector<float> least(kRun, -kMostSigned);
    const std::vector<float> beyond(kRun, std::nextafter(kMostSigned, kInfinity));
    const std::vector<float> below(kRun, -kInfinity);
    for (const std::vector<float>& values : {most, least, beyond, below})
        expectSignedExact(values);
    EXPECT_EQ(answersTo(most).front().leftSigned, 0u);
    EXPECT_EQ(answersTo(beyond).front().leftSigned, kRun);
    EXPECT_EQ(answersTo(beyond).front().signedFour, answersTo(most).front().signedFour);
    EXPECT_EQ(answersTo(below).front().signedFour, answersTo(least).front().signedFour);
}

// Sums that pass 0 again and again, by one unit and by many.
TEST_F(FixedPointTest, BorrowsRunThroughAllWordsAndBack) {
    const float unit = std::ldexp(1.0f, kSumLowestExponent);
    for (const float sign : {1.0f, -1.0f}) {
        std::vector<float> values = {sign * unit,       -2 * sign * unit, sign * 65536.0f, sign * 65536.0f,
                                     -sign * 131072.0f, sign * unit,      -sign * unit};
        values.resize(kRun, 0.0f);
        expectSignedExact(values);
        EXPECT_EQ(answersTo(values).front().signedValue, -sign * unit);
    }
}

// What is added comes off again, to the last bit, in whatever order.
TEST_F(FixedPointTest, OppositeValuesLeaveNothing) {
    std::vector<float> values;
    for (const float x : randomValues(-16.0f, 16.0f, 1024 * kRun / 2)) {
        values.push_back(x);
        values.push_back(-x);
    }
    for (const Answer& answer : answersTo(values))
        ASSERT_EQ(answer.signedFour, (std::array<uint32_t, 4>{}));
}

} // namespace
} // namespace lavalight::test
