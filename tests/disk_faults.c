/* Calls of the system that fail, for a program under LD_PRELOAD.

   FAULT_PLACE    directory whose files are concerned
   FAULT_CALL     write, fsync, rename, open, close, truncate or copy
   FAULT_NUMBER   number of the call that fails, from 1
   FAULT_ERROR    number of the error; 0: a write that takes half of the bytes
   FAULT_LASTS    1: later calls of the kind fail too, as on a full disk
   FAULT_NOTE     file that is written when a call has failed */

#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>
#include <unistd.h>

static int count;

#define REAL(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

static const char *text(const char *name)
{
    const char *found = getenv(name);
    return found ? found : "";
}

static int concerns(const char *path)
{
    const char *place = text("FAULT_PLACE");
    return *place && strncmp(path, place, strlen(place)) == 0;
}

static int concerns_file(int file)
{
    char link[64], path[4096];
    snprintf(link, sizeof link, "/proc/self/fd/%d", file);
    ssize_t size = readlink(link, path, sizeof path - 1);
    if (size < 0)
        return 0;
    path[size] = 0;
    return concerns(path);
}

static int concerns_name(int directory, const char *path)
{
    char whole[8192];
    if (*path == '/')
        return concerns(path);
    if (directory != AT_FDCWD || !getcwd(whole, 4096))
        return 0;
    strcat(whole, "/");
    strncat(whole, path, 4000);
    return concerns(whole);
}

/* True if this call is to fail; errno is set. */
static int fails(const char *call)
{
    if (strcmp(call, text("FAULT_CALL")))
        return 0;
    int number = atoi(text("FAULT_NUMBER")), now = __sync_add_and_fetch(&count, 1);
    if (now != number && !(now > number && *text("FAULT_LASTS") == '1'))
        return 0;
    int note = REAL(open)(text("FAULT_NOTE"), O_WRONLY | O_CREAT, 0600);
    if (note >= 0)
        REAL(close)(note);
    errno = atoi(text("FAULT_ERROR"));
    return 1;
}

#define SHORT (errno == 0)

ssize_t write(int file, const void *data, size_t size)
{
    if (concerns_file(file) && fails("write"))
        return SHORT ? REAL(write)(file, data, (size + 1) / 2) : -1;
    return REAL(write)(file, data, size);
}

ssize_t pwrite(int file, const void *data, size_t size, off_t at)
{
    if (concerns_file(file) && fails("write"))
        return SHORT ? REAL(pwrite)(file, data, (size + 1) / 2, at) : -1;
    return REAL(pwrite)(file, data, size, at);
}

ssize_t pwrite64(int file, const void *data, size_t size, off64_t at)
{
    if (concerns_file(file) && fails("write"))
        return SHORT ? REAL(pwrite64)(file, data, (size + 1) / 2, at) : -1;
    return REAL(pwrite64)(file, data, size, at);
}

#include <sys/sendfile.h>

ssize_t sendfile64(int to, int from, off64_t *at, size_t size)
{
    if (concerns_file(to) && fails("copy"))
        return SHORT ? REAL(sendfile64)(to, from, at, (size + 1) / 2) : -1;
    return REAL(sendfile64)(to, from, at, size);
}

int fsync(int file)
{
    return concerns_file(file) && fails("fsync") ? -1 : REAL(fsync)(file);
}

int ftruncate64(int file, off64_t size)
{
    return concerns_file(file) && fails("truncate") ? -1 : REAL(ftruncate64)(file, size);
}

int ftruncate(int file, off_t size)
{
    return concerns_file(file) && fails("truncate") ? -1 : REAL(ftruncate)(file, size);
}

int rename(const char *from, const char *to)
{
    return concerns_name(AT_FDCWD, to) && fails("rename") ? -1 : REAL(rename)(from, to);
}

int close(int file)
{
    /* Errors of earlier writes are reported when a file is closed that was written. */
    if ((fcntl(file, F_GETFL) & O_ACCMODE) != O_RDONLY && concerns_file(file) && fails("close")) {
        int error = errno;
        REAL(close)(file);
        errno = error;
        return -1;
    }
    return REAL(close)(file);
}

#define OPEN(name, real, before, ...)                                                        \
    {                                                                                        \
        mode_t mode = 0;                                                                     \
        if (flags & O_CREAT) {                                                               \
            va_list rest;                                                                    \
            va_start(rest, flags);                                                           \
            mode = va_arg(rest, mode_t);                                                     \
            va_end(rest);                                                                    \
        }                                                                                    \
        if ((flags & (O_WRONLY | O_RDWR)) && concerns_name(before, path) && fails("open"))   \
            return -1;                                                                       \
        return REAL(real)(__VA_ARGS__, path, flags, mode);                                   \
    }

int openat(int directory, const char *path, int flags, ...)
OPEN(openat, openat, directory, directory)
int openat64(int directory, const char *path, int flags, ...)
OPEN(openat64, openat64, directory, directory)
int open(const char *path, int flags, ...)
OPEN(open, openat, AT_FDCWD, AT_FDCWD)
int open64(const char *path, int flags, ...)
OPEN(open64, openat64, AT_FDCWD, AT_FDCWD)
