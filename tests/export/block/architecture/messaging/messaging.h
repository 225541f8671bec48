/* As much of Basilisk's header as a module needs: a message, and what reads one. */
#pragma once
#include <cstdint>

template <typename Payload> class Message {
public:
    Payload zeroMsgPayload{};
    Payload payload{};
    void write(Payload *written, int64_t, uint64_t) { payload = *written; }
};

template <typename Payload> class ReadFunctor {
public:
    void subscribeTo(const Message<Payload> *message) { source = message; }
    bool isLinked() const { return source != nullptr; }
    Payload operator()() const { return source->payload; }

private:
    const Message<Payload> *source = nullptr;
};
