"""What the service is made of, and whether it may be: advisories, licences, bill of materials.

- `pinned`: what the lock files pin, in Python and in the studio's bundle.
- `audit`: known vulnerabilities. `licences`: what each part allows. `sbom`: the parts as CycloneDX.
"""
