/* Threads that run parts of a sequence one after the other: each has a context of its own current, in a share group with others. */
#include "random.h"
#include <pthread.h>
#include <semaphore.h>
#include <stdlib.h>

struct worker {
    pthread_t thread;
    sem_t go, done;
    struct run *run;
    void (*work)(void); /* null: it ends */
};

static void *serve(void *of)
{
    struct worker *worker = of;
    for (;;) {
        sem_wait(&worker->go);
        R = worker->run;
        if (!worker->work)
            break;
        worker->work();
        sem_post(&worker->done);
    }
    W->current(NULL, 0, 0);
    return NULL;
}

struct worker *worker_start(void)
{
    struct worker *worker = calloc(1, sizeof *worker);
    if (!worker || sem_init(&worker->go, 0, 0) || sem_init(&worker->done, 0, 0) || pthread_create(&worker->thread, NULL, serve, worker))
        fail("no thread");
    return worker;
}

void worker_run(struct worker *worker, void (*work)(void))
{
    if (!worker) {
        work();
        return;
    }
    worker->run = R;
    worker->work = work;
    sem_post(&worker->go);
    sem_wait(&worker->done);
}

void worker_stop(struct worker *worker)
{
    if (!worker)
        return;
    worker->work = NULL;
    sem_post(&worker->go);
    pthread_join(worker->thread, NULL);
    sem_destroy(&worker->go);
    sem_destroy(&worker->done);
    free(worker);
}
