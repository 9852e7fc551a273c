"""The calls of the service as data; `gelenk.client` sends them.

- `operations`: the operations as methods of both clients; `kept`: those on stored robots and jobs.
- `arrays`: operations on large batches as arrays; `jobs`: operations as jobs.
- `call`: a call, and how a description becomes a method; `exchange`: its JSON; `npy`: its arrays.
- `patience`: when to send a call again; `reading`: turns a reply into an answer or an exception.
- `refusals`: turns a problem from the service back into the core's own exception.
"""
