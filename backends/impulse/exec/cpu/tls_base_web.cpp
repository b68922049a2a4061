// Where the thread-local variables of a .wasm of one thread begin. lld 19 adds that twice to their addresses, once when
// it links and once when the program runs (llvm-project#116136), which this makes 0. lld 20 needs it no more.
asm(R"(
  .globaltype __tls_base, i32
  .globl __tls_base
__tls_base:
)");
