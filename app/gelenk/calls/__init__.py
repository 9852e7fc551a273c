"""The calls of the service as data: what `gelenk.client` sends.

- `operations`: the operations as methods of both clients; `kept`: those on stored robots and jobs.
- `arrays`: the same of large batches; `jobs`: the same as jobs.
- `call`: a call, and how a description becomes a method; `exchange`: its JSON; `npy`: its arrays.
- `patience`: when a call is sent again; `reading`: what has come back, an answer or an exception.
- `refusals`: a problem on the wire, turned back into the core's own exception.
"""
