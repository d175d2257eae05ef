#include "support/desktop/drag_source.h"

#include <chrono>
#include <stdexcept>
#include <thread>

#include <X11/Xatom.h>
#include <X11/Xlib.h>

namespace lavalight::test {
namespace {

constexpr std::chrono::seconds kPatience(10);
constexpr long kVersion = 5;

// The source of one drag: XdndEnter, XdndPosition until the target says XdndStatus, XdndDrop; the target asks
// for the selection, gets the URI, and ends it with XdndFinished.
class Drag {
  public:
    Drag(std::string uri, Window target) : uri_(std::move(uri)), target_(target) {
        display_ = ::XOpenDisplay(nullptr);
        if (display_ == nullptr)
            throw std::runtime_error("no desktop to drag on");
        source_ = ::XCreateSimpleWindow(display_, ::XDefaultRootWindow(display_), 0, 0, 1, 1, 0, 0, 0);
        ::XSetSelectionOwner(display_, atom("XdndSelection"), source_, CurrentTime);
    }
    ~Drag() { ::XCloseDisplay(display_); }
    Drag(const Drag&) = delete;
    Drag& operator=(const Drag&) = delete;

    void run() {
        send("XdndEnter", {kVersion << 24, static_cast<long>(atom("text/uri-list")), None, None});
        send("XdndPosition", {0, rootPosition(), CurrentTime, static_cast<long>(atom("XdndActionCopy"))});
        const auto deadline = std::chrono::steady_clock::now() + kPatience;
        while (!isFinished_ && std::chrono::steady_clock::now() < deadline) {
            while (::XPending(display_) > 0) {
                XEvent event;
                ::XNextEvent(display_, &event);
                answer(event);
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        if (!isFinished_)
            throw std::runtime_error("the window did not take the drop");
    }

  private:
    struct Words {
        long second = 0;
        long third = 0;
        long fourth = 0;
        long fifth = 0;
    };

    [[nodiscard]] Atom atom(const char* name) const { return ::XInternAtom(display_, name, False); }

    // x and y of the middle of the target on the whole desktop, 16 bits each.
    [[nodiscard]] long rootPosition() const {
        XWindowAttributes size;
        ::XGetWindowAttributes(display_, target_, &size);
        int x = 0;
        int y = 0;
        Window child = None;
        ::XTranslateCoordinates(display_, target_, size.root, size.width / 2, size.height / 2, &x, &y,
                                &child);
        return static_cast<long>(x) << 16 | y;
    }

    void send(const char* message, const Words& words) {
        XEvent event{};
        event.xclient.type = ClientMessage;
        event.xclient.window = target_;
        event.xclient.message_type = atom(message);
        event.xclient.format = 32;
        event.xclient.data.l[0] = static_cast<long>(source_);
        event.xclient.data.l[1] = words.second;
        event.xclient.data.l[2] = words.third;
        event.xclient.data.l[3] = words.fourth;
        event.xclient.data.l[4] = words.fifth;
        ::XSendEvent(display_, target_, False, NoEventMask, &event);
        ::XFlush(display_);
    }

    void answer(const XEvent& event) {
        if (event.type == SelectionRequest)
            handOver(event.xselectionrequest);
        else if (event.type == ClientMessage && event.xclient.message_type == atom("XdndStatus"))
            drop((event.xclient.data.l[1] & 1) != 0);
        else if (event.type == ClientMessage && event.xclient.message_type == atom("XdndFinished"))
            isFinished_ = true;
    }

    void drop(bool isWanted) {
        if (!isWanted)
            throw std::runtime_error("the window does not want the drop");
        if (!isDropped_)
            send("XdndDrop", {0, CurrentTime, 0, 0});
        isDropped_ = true;
    }

    void handOver(const XSelectionRequestEvent& request) {
        ::XChangeProperty(display_, request.requestor, request.property, request.target, 8, PropModeReplace,
                          reinterpret_cast<const unsigned char*>(uri_.data()), static_cast<int>(uri_.size()));
        XEvent done{};
        done.xselection.type = SelectionNotify;
        done.xselection.requestor = request.requestor;
        done.xselection.selection = request.selection;
        done.xselection.target = request.target;
        done.xselection.property = request.property;
        done.xselection.time = request.time;
        ::XSendEvent(display_, request.requestor, False, NoEventMask, &done);
        ::XFlush(display_);
    }

    std::string uri_;
    Window target_;
    Display* display_ = nullptr;
    Window source_ = None;
    bool isDropped_ = false;
    bool isFinished_ = false;
};

} // namespace

void dragAndDrop(const std::string& path, unsigned long window) {
    Drag("file://" + path + "\r\n", window).run();
}

} // namespace lavalight::test
