// A picture on its way to the window.
#pragma once

#include <cstdint>
#include <span>

#include <glm/glm.hpp>
#include <vulkan/vulkan_raii.hpp>

namespace lavalight {

// Memory of one picture on the device that shows it. Grows as pictures do.
class PictureTexture {
  public:
    PictureTexture(const vk::raii::PhysicalDevice& physical, const vk::raii::Device& device)
        : physical_(&physical), device_(&device) {}

    [[nodiscard]] bool isEmpty() const { return size_ == glm::uvec2(0); }

    // Not while the device works with it. `pixels`: bytes R, G, B, 255, rows from the top. Throws Error with
    // the picture from before.
    void set(const glm::uvec2& size, std::span<const uint32_t> pixels);

    // Part of a window and where it lies, in pixels.
    struct Target {
        vk::Image image;   // in the layout for transfers to it
        glm::uvec2 window; // size that the whole picture fills
        glm::uvec2 from;   // the part's left top
        glm::uvec2 to;     // and right bottom
    };
    // Records the way of what was set last, one pixel as good as another where sizes differ.
    void draw(const vk::raii::CommandBuffer& commands, const Target& target);

  private:
    // What one size of picture takes.
    struct Store {
        vk::raii::Buffer staging = nullptr;
        vk::raii::DeviceMemory stagingMemory = nullptr;
        vk::raii::Image image = nullptr;
        vk::raii::DeviceMemory imageMemory = nullptr;
        void* mapped = nullptr;
    };

    [[nodiscard]] Store allocate(const glm::uvec2& size) const;
    void upload(const vk::raii::CommandBuffer& commands);
    [[nodiscard]] vk::raii::DeviceMemory memoryFor(const vk::MemoryRequirements& needs,
                                                   vk::MemoryPropertyFlags flags) const;

    const vk::raii::PhysicalDevice* physical_;
    const vk::raii::Device* device_;
    glm::uvec2 size_{0};
    bool isUploaded_ = false;
    Store store_;
};

} // namespace lavalight
