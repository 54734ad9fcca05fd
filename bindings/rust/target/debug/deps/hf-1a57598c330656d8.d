/tmp/w/integ/bindings/rust/target/debug/deps/hf-1a57598c330656d8.d: src/lib.rs src/call.rs src/core.rs src/api.rs src/raw.rs

/tmp/w/integ/bindings/rust/target/debug/deps/libhf-1a57598c330656d8.rmeta: src/lib.rs src/call.rs src/core.rs src/api.rs src/raw.rs

src/lib.rs:
src/call.rs:
src/core.rs:
src/api.rs:
src/raw.rs:
