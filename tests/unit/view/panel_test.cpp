// The panels, without a window: a mouse finds their items by where they are, and clicks.
#include "view/panel.h"

#include <limits>
#include <memory>
#include <optional>
#include <sstream>
#include <string>

#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>
#include <imgui.h>
#include <imgui_internal.h>

#include "render/presets.h"
#include "session/builtin.h"
#include "view/inspector_panel.h"

namespace lavalight::test {
namespace {

// A Cornell box with a second camera, a map, variants and an animation.
std::shared_ptr<const Scene> furnishedScene() {
    Scene scene = loadScene("cornell-box");
    scene.cameras.push_back(scene.cameras.front());
    scene.cameras.back().name = "above";
    scene.cameras.back().position.y += 1.0f;
    scene.environmentMap = EnvironmentMap{};
    scene.variants = {"beach", "street"};
    scene.animations = {{"wave", 2.0f}};
    return std::make_shared<const Scene>(std::move(scene));
}

ViewState viewOf(const std::shared_ptr<const Scene>& scene) {
    const Camera& camera = scene->cameras.front();
    return {"test.gltf", {}, scene, CameraRig(camera, scene->bounds), camera, {}, {}, {}};
}

class PanelTest : public testing::Test {
  protected:
    PanelTest() {
        ImGui::CreateContext();
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr;
        io.DisplaySize = ImVec2(800.0f, 1000.0f);
        io.DeltaTime = 0.1f;
        unsigned char* pixels = nullptr;
        int width = 0;
        int height = 0;
        io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
    }
    ~PanelTest() override { ImGui::DestroyContext(); }

    void draw() {
        if (inspection_) {
            drawPath(*inspection_, view_, glm::vec2(800.0f, 1000.0f));
            wantsSample_ |= drawInspector(*inspection_, sample_);
        } else {
            const PanelAnswer answer = drawPanel(view_, {statistics_, statistics_});
            wantsScene_ |= answer.wantsScene;
            wantsSave_ |= answer.wantsSave;
        }
    }
    void frame() {
        ImGui::NewFrame();
        draw();
        ImGui::Render();
    }

    // All that is written on the panel, which has been there before.
    std::string text() {
        frame();
        ImGui::NewFrame();
        ImGui::LogToClipboard(); // ImGui's own, and until the panel's end
        draw();
        ImGui::Render();
        return ImGui::GetClipboardText();
    }

    // Where the mouse is over the item, from its left; it must be there. "left/MIS": of the scope "left".
    ImVec2 find(const std::string& window, const std::string& label) {
        frame();
        const ImGuiWindow* const place = ImGui::FindWindowByName(window.c_str());
        if (place == nullptr) {
            ADD_FAILURE() << "no window " << window;
            return {};
        }
        ImGuiID id = place->ID;
        std::istringstream scopes(label);
        for (std::string name; std::getline(scopes, name, '/');)
            id = ImHashStr(name.c_str(), 0, id);
        for (float y = place->Pos.y; y < place->Pos.y + place->Size.y; y += 4.0f) {
            for (float x = place->Pos.x + 8.0f; x < place->Pos.x + 120.0f; x += 8.0f) {
                moveTo(ImVec2(x, y));
                if (ImGui::GetCurrentContext()->HoveredId == id)
                    return {x, y};
            }
        }
        ADD_FAILURE() << "no " << label << " in " << window;
        return {};
    }
    void moveTo(const ImVec2& at) {
        ImGui::GetIO().MousePos = at;
        frame();
    }
    void click(const std::string& window, const std::string& label) {
        moveTo(find(window, label));
        ImGui::GetIO().MouseDown[0] = true;
        frame();
        ImGui::GetIO().MouseDown[0] = false;
        frame();
        frame();
    }
    // Presses on a slider or number, and moves the mouse right.
    void drag(const std::string& window, const std::string& label, float pixels) {
        const ImVec2 at = find(window, label);
        moveTo(at);
        ImGui::GetIO().MouseDown[0] = true;
        frame();
        moveTo(ImVec2(at.x + pixels, at.y));
        ImGui::GetIO().MouseDown[0] = false;
        frame();
    }
    void choose(const std::string& label, const std::string& entry) {
        click("Lavalight", label);
        click("##Combo_00", entry);
    }

    ViewState view_ = viewOf(furnishedScene());
    std::optional<LiveStatistics> statistics_;
    std::optional<PixelInspection> inspection_;
    uint32_t sample_ = 0;
    bool wantsSample_ = false;
    bool wantsScene_ = false;
    bool wantsSave_ = false;
};

// The panel with Scene open, and with Estimator and View closed.
class ScenePanelTest : public PanelTest {
  protected:
    ScenePanelTest() {
        for (const char* header : {"Estimator", "View", "Scene"})
            click("Lavalight", header);
    }
};

TEST_F(ScenePanelTest, CameraIsChosenAndHomeIsThere) {
    view_.homeOptions = {{"camera-position", "1,2,3"}};
    choose("camera", "##1");
    EXPECT_EQ(view_.home.name, "above");
    EXPECT_EQ(view_.homeOptions, (OptionPairs{{"camera", "above"}}));
    EXPECT_EQ(view_.rig.camera().position, view_.scene->cameras.back().position);
    EXPECT_FALSE(wantsScene_);
    choose("camera", "##0");
    EXPECT_TRUE(view_.homeOptions.empty()) << "the first needs no option";
}

// glTF leaves the naming of cameras open, and ImGui ends the program over an item without a name.
TEST_F(ScenePanelTest, CamerasAndVariantsNeedNoNamesOfTheirOwn) {
    Scene scene = *view_.scene;
    scene.cameras.push_back(scene.cameras.back());
    scene.cameras.front().name = "";
    scene.cameras[1].name = scene.cameras[2].name = "two##of them";
    scene.cameras[2].position.y += 1.0f;
    scene.variants = {"", "beach", "beach"};
    view_ = viewOf(std::make_shared<const Scene>(std::move(scene)));
    EXPECT_NE(text().find("number 0"), std::string::npos) << "the chosen one";
    click("Lavalight", "camera");
    EXPECT_NE(text().find("two##of them"), std::string::npos);
    click("##Combo_00", "##2");
    EXPECT_EQ(view_.rig.camera().position, view_.scene->cameras.back().position);
    EXPECT_EQ(view_.homeOptions, (OptionPairs{{"camera", "2"}})) << "a name finds the first of them";
    choose("variant", "##3");
    EXPECT_EQ(view_.import.variant, "2");
    choose("variant", "##1");
    EXPECT_EQ(view_.import.variant, "0") << "no text would be no variant";
}

TEST_F(ScenePanelTest, LensIsOpenedAndFocused) {
    const float before = view_.rig.camera().verticalFov;
    drag("Lavalight", "field of view", 60.0f);
    EXPECT_GT(view_.rig.camera().verticalFov, before);
    EXPECT_EQ(view_.rig.camera().lensRadius, 0.0f);
    drag("Lavalight", "aperture", 60.0f);
    EXPECT_GT(view_.rig.camera().lensRadius, 0.0f);
    const float focus = view_.rig.camera().focusDistance;
    drag("Lavalight", "focus", 60.0f);
    EXPECT_NE(view_.rig.camera().focusDistance, focus);
}

TEST_F(ScenePanelTest, EnvironmentIsTurnedAndDimmedWithoutReadingTheScene) {
    drag("Lavalight", "map's rotation", 20.0f);
    EXPECT_NE(view_.settings.lighting.rotation, 0.0f);
    drag("Lavalight", "environment", 50.0f);
    EXPECT_GT(view_.settings.lighting.intensity, 1.0f);
    EXPECT_FALSE(wantsScene_);
}

TEST_F(ScenePanelTest, AnotherLightAsksForTheSceneAndTheOldOneShinesUntilItIsThere) {
    choose("light", "##1");
    EXPECT_EQ(view_.light.procedural, ProceduralEnvironment::studio);
    EXPECT_EQ(view_.settings.lighting, LightingSettings{});
    EXPECT_TRUE(wantsScene_);
    wantsScene_ = false;
    choose("light", "##1");
    EXPECT_FALSE(wantsScene_) << "it shines already";
    choose("light", "##2");
    drag("Lavalight", "sun's elevation", -60.0f);
    drag("Lavalight", "turbidity", 60.0f);
    EXPECT_EQ(view_.light.procedural, ProceduralEnvironment::sky);
    EXPECT_NE(view_.light.sky.sunElevation, SkySettings{}.sunElevation);
    EXPECT_NE(view_.light.sky.turbidity, SkySettings{}.turbidity);
    EXPECT_TRUE(wantsScene_);
    choose("light", "##3");
    EXPECT_EQ(view_.light.constant, glm::vec3(1.0f));
    EXPECT_EQ(view_.light.procedural, ProceduralEnvironment::none);
    choose("light", "##0");
    EXPECT_FALSE(bringsLight(view_.light));
}

TEST_F(ScenePanelTest, AMapThatWasUsedIsOfferedAgain) {
    view_.light.mapFile = "maps/garden.hdr";
    frame();
    choose("light", "##3");
    EXPECT_TRUE(view_.light.mapFile.empty());
    choose("light", "##4");
    EXPECT_EQ(view_.light.mapFile, "maps/garden.hdr");
}

TEST_F(ScenePanelTest, VariantAndMomentAskForTheScene) {
    choose("variant", "##2");
    EXPECT_EQ(view_.import.variant, "street");
    EXPECT_TRUE(wantsScene_);
    wantsScene_ = false;
    choose("variant", "##2");
    EXPECT_FALSE(wantsScene_) << "it is there already";
    choose("variant", "##0");
    EXPECT_EQ(view_.import.variant, "");
    EXPECT_TRUE(wantsScene_);
    wantsScene_ = false;
    drag("Lavalight", "moment", 60.0f);
    EXPECT_GT(view_.import.seconds.value(), 0.0);
    EXPECT_LE(view_.import.seconds.value(), 2.0);
    EXPECT_TRUE(wantsScene_);
}

TEST_F(ScenePanelTest, AScenesPanelOffersOnlyWhatItHas) {
    view_ = viewOf(std::make_shared<const Scene>(loadScene("cornell-box")));
    frame();
    EXPECT_NONFATAL_FAILURE(find("Lavalight", "variant"), "no variant");
    EXPECT_NONFATAL_FAILURE(find("Lavalight", "moment"), "no moment");
    EXPECT_NONFATAL_FAILURE(find("Lavalight", "map's rotation"), "no map's rotation");
}

TEST_F(PanelTest, PictureIsChosenForEachSide) {
    choose("picture", "depth");
    EXPECT_EQ(view_.shown[0], (ShownLayer{kDepthPlane, false}));
    view_.isSplit = true;
    choose("right", "denoised");
    EXPECT_EQ(view_.shown[1], kDenoisedColor);
    choose("denoiser", "high");
    EXPECT_EQ(view_.quality, DenoiseQuality::high);
    choose("left", "color");
    EXPECT_EQ(view_.shown[0], ShownLayer{});
}

TEST_F(PanelTest, WithoutADenoiserThePanelSaysHowToGetItAndOffersNone) {
    view_.whyNotDenoised = "cannot denoise: there is no library; get it";
    EXPECT_NE(text().find(view_.whyNotDenoised), std::string::npos);
    choose("picture", "denoised");
    EXPECT_EQ(view_.shown[0], ShownLayer{});
}

TEST_F(PanelTest, BackgroundIsNothingAColourOrARadiance) {
    choose("background", "transparent");
    EXPECT_EQ(view_.settings.background.kind, Background::transparent);
    EXPECT_FALSE(view_.tone.backdrop);
    view_.backdrop = glm::vec3(0.5f, 1.0f, 0.0f);
    choose("background", "a colour");
    EXPECT_EQ(view_.settings.background.kind, Background::transparent);
    ASSERT_TRUE(view_.tone.backdrop);
    EXPECT_NEAR(view_.tone.backdrop->x, 0.2159f, 1e-4f) << "the linear value of #80";
    choose("background", "a radiance");
    EXPECT_EQ(view_.settings.background.kind, Background::constant);
    EXPECT_FALSE(view_.tone.backdrop);
    choose("background", "environment");
    EXPECT_EQ(view_.settings.background, BackgroundSettings{});
}

TEST_F(PanelTest, ExposureIsTheImagesOrStaysWhereThatWas) {
    statistics_ = LiveStatistics{};
    statistics_->exposure = 1.5f;
    click("Lavalight", "exposure by the image");
    EXPECT_TRUE(view_.exposesByImage);
    moveTo(ImVec2(700.0f, 900.0f)); // what a tick means would end the log
    const std::string shown = text();
    EXPECT_NE(shown.find("1.5 stops"), std::string::npos) << shown;
    click("Lavalight", "exposure by the image");
    EXPECT_FALSE(view_.exposesByImage);
    EXPECT_EQ(view_.tone.exposure, 1.5f);
}

TEST_F(PanelTest, SavesWithItsButton) {
    click("Lavalight", "save EXR and PNG");
    EXPECT_TRUE(wantsSave_);
}

// Presets are single settings of the lecture, but for the seed.
TEST_F(PanelTest, AScheduleBringsAnAcceleratorOfItsOwn) {
    view_.canBeHosted = true;
    view_.settings.work = {.schedule = Schedule::hosted, .accelerator = RayAccelerator::bvh16};
    click("Lavalight", "View");
    click("Lavalight", "Render");
    choose("left/schedule", "fused");
    EXPECT_EQ(view_.settings.work.schedule, Schedule::fused);
    EXPECT_EQ(view_.settings.work.accelerator, RayAccelerator::automatic);
}

TEST_F(PanelTest, PresetChangesTheEstimatorAndKeepsTheSeed) {
    view_.settings.estimator.seed = 17;
    const Preset& preset = presets().front();
    choose("left/preset", std::string(preset.name));
    EstimatorSettings wanted = preset.settings;
    wanted.seed = 17;
    EXPECT_EQ(view_.settings.estimator, wanted);
    EXPECT_NE(wanted, EstimatorSettings{}) << "a preset that changes nothing shows nothing";
}

TEST_F(PanelTest, SettingsThatOthersNeedComeAndGoWithThem) {
    click("Lavalight", "View");
    const EstimatorSettings& estimator = view_.settings.estimator;
    EXPECT_NONFATAL_FAILURE(find("Lavalight", "left/survival"), "no left/survival");
    choose("left/roulette", "constant");
    EXPECT_EQ(estimator.roulette, Roulette::constant);
    drag("Lavalight", "left/survival", 40.0f);
    EXPECT_NE(estimator.rouletteProbability, EstimatorSettings{}.rouletteProbability);
    click("Lavalight", "left/MIS counts survival");
    EXPECT_TRUE(estimator.misSurvival);
    choose("left/roulette", "throughput");
    EXPECT_FALSE(estimator.misSurvival) << "it has no meaning there";
    click("Lavalight", "left/clamp indirect light");
    EXPECT_EQ(estimator.clampIndirect, 10.0f);
    drag("Lavalight", "left/at most##clamp indirect light", 50.0f);
    EXPECT_GT(estimator.clampIndirect, 10.0f);
    click("Lavalight", "left/clamp indirect light");
    EXPECT_EQ(estimator.clampIndirect, std::numeric_limits<float>::infinity());
}

TEST_F(PanelTest, TheRightSideHasAnEstimatorOfItsOwn) {
    click("Lavalight", "side by side");
    ASSERT_TRUE(view_.isSplit);
    click("Lavalight", "Estimator");
    click("Lavalight", "right/next-event estimation");
    EXPECT_FALSE(view_.other.nextEventEstimation);
    EXPECT_TRUE(view_.settings.estimator.nextEventEstimation);
}

TEST_F(PanelTest, StatisticsTellSharesAndRates) {
    statistics_ = LiveStatistics{};
    statistics_->samples = 7;
    statistics_->seconds = 2.0;
    statistics_->paths = 3'000'000;
    EXPECT_NE(text().find("error not known yet"), std::string::npos);
    statistics_->error = 0.0004;
    statistics_->kernels = {{"extend", {3.0, 1}}, {"shade", {1.0, 1}}};
    statistics_->raysPerBounce = {100, 50, 0, 0};
    const std::string shown = text();
    for (const char* words : {"7 samples in 2.0 s", "1.50 M paths/s", "error 2.0 %", "extend 75 %",
                              "shade 25 %", "queue by bounce"})
        EXPECT_NE(shown.find(words), std::string::npos) << words << " in " << shown;
}

PixelInspection inspectionOf(const std::shared_ptr<const Scene>& scene) {
    PixelInspection inspection;
    inspection.scene = scene;
    inspection.sample = 3;
    TracedVertex wall{};
    wall.position = scene->bounds.upper;
    wall.t = 1.0f;
    wall.flags = kTracedShadowRay | kTracedGoesOn;
    TracedVertex sky{};
    sky.t = std::numeric_limits<float>::infinity();
    sky.material = 0xffffffffu; // no material
    inspection.path.vertices = {wall, wall, sky};
    return inspection;
}

TEST_F(PanelTest, InspectorAsksForAnotherSampleAndKnowsThatTheSkyHasNoMaterial) {
    inspection_ = inspectionOf(view_.scene);
    const std::string shown = text();
    EXPECT_NE(shown.find("environment"), std::string::npos) << shown;
    EXPECT_NE(shown.find(view_.scene->materials.front().name), std::string::npos) << shown;
    EXPECT_EQ(sample_, 3u);
    EXPECT_FALSE(wantsSample_);
    drag("Pixel", "sample", 50.0f);
    EXPECT_TRUE(wantsSample_);
}

} // namespace
} // namespace lavalight::test
