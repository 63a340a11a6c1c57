// Loaded before the C library by tests that end a program at one certain moment: a file that is to get its
// name waits for ever instead, so that the program cannot be done before it is ended.
//   RHOLM_TEST_HOLD   letters within the new path, or at its end if a '$' follows them
//   RHOLM_TEST_AFTER  how many entries that are complete its folder has by then (0 if not given)
//   RHOLM_TEST_HELD   a file that is made by then
#define _GNU_SOURCE
#include <dirent.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static int has_letters(const char* path, const char* letters) {
  const size_t n = strlen(letters), length = strlen(path);
  if (n == 0 || letters[n - 1] != '$') return strstr(path, letters) != NULL;
  return length >= n - 1 && strncmp(path + length - (n - 1), letters, n - 1) == 0;
}

static int entries_beside(const char* path) {
  char folder[4096] = ".";
  const char* end = strrchr(path, '/');
  if (end != NULL) snprintf(folder, sizeof folder, "%.*s", (int)(end - path), path);
  DIR* list = opendir(folder);
  if (list == NULL) return 0;
  int n = 0;
  for (const struct dirent* entry = readdir(list); entry != NULL; entry = readdir(list)) {
    n += entry->d_name[0] != '.' && !has_letters(entry->d_name, ".part$");
  }
  closedir(list);
  return n;
}

static void hold(const char* path) {
  const char* letters = getenv("RHOLM_TEST_HOLD");
  const char* after = getenv("RHOLM_TEST_AFTER");
  const char* held = getenv("RHOLM_TEST_HELD");
  if (letters == NULL || held == NULL || !has_letters(path, letters)) return;
  if (entries_beside(path) < (after == NULL ? 0 : atoi(after))) return;
  close(open(held, O_WRONLY | O_CREAT | O_CLOEXEC, 0600));
  for (;;) pause();
}

int rename(const char* from, const char* to) {
  hold(to);
  return ((int (*)(const char*, const char*))dlsym(RTLD_NEXT, "rename"))(from, to);
}
