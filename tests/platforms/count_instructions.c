/* A plug-in of qemu-user that counts the instructions a program executes: -plugin libcount_instructions.so. It prints
 * the count when the program ends. The declarations are those of version 1 of the plug-in interface, which Debian's
 * packages have no header for. */
#include <inttypes.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

typedef uint64_t PluginId;
struct qemu_plugin_tb;
extern size_t qemu_plugin_tb_n_insns(const struct qemu_plugin_tb* block);
extern void qemu_plugin_register_vcpu_tb_trans_cb(PluginId id, void (*seen)(PluginId, struct qemu_plugin_tb*));
extern void qemu_plugin_register_vcpu_tb_exec_inline(struct qemu_plugin_tb* block, int operation, void* counter,
                                                     uint64_t add);
extern void qemu_plugin_register_atexit_cb(PluginId id, void (*end)(PluginId, void*), void* user);

int qemu_plugin_version = 1;
static uint64_t count;

enum { ADD = 0 }; /* the operation "add to a counter" */

/* A translated block always runs from its first instruction to its last. */
static void block_seen(PluginId id, struct qemu_plugin_tb* block) {
  (void)id;
  qemu_plugin_register_vcpu_tb_exec_inline(block, ADD, &count, qemu_plugin_tb_n_insns(block));
}

static void program_ended(PluginId id, void* user) {
  (void)id, (void)user;
  fprintf(stderr, "instructions %" PRIu64 "\n", count);
}

int qemu_plugin_install(PluginId id, const void* info, int argc, char** argv);
int qemu_plugin_install(PluginId id, const void* info, int argc, char** argv) {
  (void)info, (void)argc, (void)argv;
  qemu_plugin_register_vcpu_tb_trans_cb(id, block_seen);
  qemu_plugin_register_atexit_cb(id, program_ended, NULL);
  return 0;
}
